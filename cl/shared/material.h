// SPDX-License-Identifier: MIT
#ifndef BOXWOOD_SHARED_MATERIAL_H
#define BOXWOOD_SHARED_MATERIAL_H
#include "shared/types.h"

// Bits of MaterialRecord::flags.
#define BOXWOOD_ALPHA_MASK 1u
#define BOXWOOD_ALPHA_BLEND 2u
#define BOXWOOD_DOUBLE_SIDED 4u
#define BOXWOOD_UNLIT 8u

// Bits of TextureRecord::format.
#define BOXWOOD_SRGB 1u ///< R, G and B are encoded by sRGB.
#define BOXWOOD_WIDE 2u ///< A texel is two words of two 16-bit values, else one of four bytes.

// Places in MaterialRecord::textures.
#define BOXWOOD_BASE_COLOR 0
#define BOXWOOD_METALLIC_ROUGHNESS 1
#define BOXWOOD_NORMAL 2
#define BOXWOOD_OCCLUSION 3
#define BOXWOOD_EMISSION 4

BOXWOOD_SHARED_BEGIN

/// A texture as one input of a material reads it: u' = rows[0] u + rows[1] v + rows[2], v' likewise from rows[3].
typedef struct TextureInput {
    uint texture; ///< Index of a TextureRecord, or BOXWOOD_NONE.
    uint uv_set;
    float rows[6];
} TextureInput;
BOXWOOD_SHARED_SIZE(TextureInput, 32)

/// A material as the device sees it; see Material.
typedef struct MaterialRecord {
    float base_color[4];
    float emission[3];
    float metallic;
    float roughness;
    float normal_scale;
    float occlusion_strength;
    float alpha_cutoff;
    float specular;
    uint flags;
    uint reserved[2]; ///< Zero.
    TextureInput textures[5];
} MaterialRecord;
BOXWOOD_SHARED_SIZE(MaterialRecord, 224)

/// A picture with its levels of detail, one behind the other in the texels of all, each half as large as the one before
/// (at least 1 across). A texel has R in its lowest bits, then G, B and alpha.
typedef struct TextureRecord {
    uint first_texel; ///< Of level 0, in words of the texels.
    uint width;
    uint height;
    uint levels;
    uint wrap_u; ///< 0 repeat, 1 mirror, 2 clamp.
    uint wrap_v;
    uint nearest;
    uint format; ///< Bits, see above.
} TextureRecord;
BOXWOOD_SHARED_SIZE(TextureRecord, 32)

BOXWOOD_SHARED_END
#endif
