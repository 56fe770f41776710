// SPDX-License-Identifier: MIT
#pragma once

namespace boxwood {

/// Operator of reductions and scans. For boxes `sum` is the hull, and min and max are not defined.
enum class Operator { sum, min, max };

} // namespace boxwood
