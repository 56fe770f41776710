// SPDX-License-Identifier: MIT
// Included by every kernel that computes with floats: the same operations give the same bits on every path, so
// multiply-adds are contracted only where the source says fma().
#ifndef BOXWOOD_RUNTIME_NUMERICS_H
#define BOXWOOD_RUNTIME_NUMERICS_H

#pragma OPENCL FP_CONTRACT OFF

#endif
