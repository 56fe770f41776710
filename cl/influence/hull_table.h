// SPDX-License-Identifier: MIT
// The outline of a box seen from one side, by which of its faces are in sight (Schmalstieg and Tobler 1999).
#ifndef BOXWOOD_INFLUENCE_HULL_TABLE_H
#define BOXWOOD_INFLUENCE_HULL_TABLE_H

// Faces in sight: bit 2k for the lower face of axis k, bit 2k + 1 for the upper one. Never both: all other entries are
// 0. Corner i of a box has the upper x, y, z where bit 0, 1, 2 of i is set. An entry holds the corners of the outline
// in order, three bits each from the lowest, and their number, 4 or 6, from bit 18.
constant uint hull_table[43] = {0x000000u, 0x1005a0u, 0x100bd9u, 0x000000u, 0x100948u, 0x196948u, 0x1a5ec8u, 0x000000u,
                                0x1007f2u, 0x193fa0u, 0x1afc99u, 0x000000u, 0x000000u, 0x000000u, 0x000000u, 0x000000u,
                                0x1002d0u, 0x18b5a0u, 0x18ded0u, 0x000000u, 0x1a52d0u, 0x19ad29u, 0x1a5ed0u, 0x000000u,
                                0x18bf90u, 0x18bfa0u, 0x18df90u, 0x000000u, 0x000000u, 0x000000u, 0x000000u, 0x000000u,
                                0x100decu, 0x196f60u, 0x1acdd9u, 0x000000u, 0x1a6f48u, 0x196f48u, 0x1a6ec8u, 0x000000u,
                                0x19fb32u, 0x193f60u, 0x1acc99u};

/// The faces in sight from an eye, given the box's corners less the eye: 0 from inside.
static inline uint faces_from_eye(float3 low, float3 high) {
    return (low.x > 0.0f ? 1u : 0u) | (high.x < 0.0f ? 2u : 0u) | (low.y > 0.0f ? 4u : 0u) | (high.y < 0.0f ? 8u : 0u) |
           (low.z > 0.0f ? 16u : 0u) | (high.z < 0.0f ? 32u : 0u);
}

/// The faces in sight for who looks along `forward` from far away.
static inline uint faces_along(float3 forward) { return faces_from_eye(forward, forward); }

#endif
