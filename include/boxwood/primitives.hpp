// SPDX-License-Identifier: MIT
// The data-parallel primitives (dissertation 2.4): all at once.
#pragma once

#include "boxwood/compact.hpp"
#include "boxwood/gather.hpp"
#include "boxwood/radix_sort.hpp"
#include "boxwood/reduce.hpp"
#include "boxwood/scan.hpp"
#include "boxwood/scatter.hpp"
#include "boxwood/segmented_reduce.hpp"
