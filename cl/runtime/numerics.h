// SPDX-License-Identifier: MIT
// Included by every kernel that computes with floats: the same operations give the same bits on every path, so
// multiply-adds are contracted only where the source says fma().
#ifndef BOXWOOD_RUNTIME_NUMERICS_H
#define BOXWOOD_RUNTIME_NUMERICS_H

#pragma OPENCL FP_CONTRACT OFF

// Scalars or, lane by lane, vectors; one instruction on most devices. Where either is NaN the result is `b`. By
// select(), not by ?:, whose lanes Oclgrind 21.10 takes wrong.
#define LESSER(a, b) select((b), (a), (a) < (b))
#define GREATER(a, b) select((b), (a), (a) > (b))

// The largest float below 1.
#define BEFORE_ONE 0x1.fffffep-1f

#endif
