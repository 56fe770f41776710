// SPDX-License-Identifier: MIT
// Stands for the text that a launch brings along (KernelRef::source); nothing when it brings none.
