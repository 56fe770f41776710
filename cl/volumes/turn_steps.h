// SPDX-License-Identifier: MIT
// The angles by which refined boxes are turned, as correctly rounded cosines and sines: cospi() and sinpi() differ
// between devices.
#ifndef BOXWOOD_VOLUMES_TURN_STEPS_H
#define BOXWOOD_VOLUMES_TURN_STEPS_H

// -4, -3, -2, -1, 0, 1, 2, 3 steps of a sixteenth of half a turn.
#define COARSE_COSINES                                                                                             \
    (float8)(0x1.6a09e6p-1f, 0x1.a9b662p-1f, 0x1.d906bcp-1f, 0x1.f6297cp-1f, 1.0f, 0x1.f6297cp-1f, 0x1.d906bcp-1f, \
             0x1.a9b662p-1f)
#define COARSE_SINES                                                                                                   \
    (float8)(-0x1.6a09e6p-1f, -0x1.1c73b4p-1f, -0x1.87de2ap-2f, -0x1.8f8b84p-3f, 0.0f, 0x1.8f8b84p-3f, 0x1.87de2ap-2f, \
             0x1.1c73b4p-1f)

// -4, -3, -2, -1, 1, 2, 3, 4 steps of an eighth of that.
#define FINE_COSINES                                                                                         \
    (float8)(0x1.fd88dap-1f, 0x1.fe9cdap-1f, 0x1.ff621ep-1f, 0x1.ffd886p-1f, 0x1.ffd886p-1f, 0x1.ff621ep-1f, \
             0x1.fe9cdap-1f, 0x1.fd88dap-1f)
#define FINE_SINES                                                                                               \
    (float8)(-0x1.917a6cp-4f, -0x1.2d520ap-4f, -0x1.91f660p-5f, -0x1.921560p-6f, 0x1.921560p-6f, 0x1.91f660p-5f, \
             0x1.2d520ap-4f, 0x1.917a6cp-4f)

#endif
