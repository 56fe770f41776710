// SPDX-License-Identifier: MIT
// Replaced by the source text given with a launch (KernelRef::source); empty when there is none.
