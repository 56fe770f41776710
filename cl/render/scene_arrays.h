// SPDX-License-Identifier: MIT
// The arrays of a scene that shading reads, and the macros that say which of them there are (see ShadingRequirements).
// An array that no macro asks for may be null.
//
// TRANSFORMS see render/surface.h
// MATERIALS  1: triangles name their materials; 0: all have the first
// NORMALS    1: vertices have normals; 0: triangles are flat
// TANGENTS   1: materials have normal textures and vertices tangents
// UV_SETS    0, 1, 2: sets of texture coordinates
// COLORS     1: vertices have colours
// TEXTURES   1: materials have textures
#ifndef BOXWOOD_RENDER_SCENE_ARRAYS_H
#define BOXWOOD_RENDER_SCENE_ARRAYS_H
#include "shared/instance.h"
#include "shared/material.h"

#if !defined(MATERIALS) || !defined(NORMALS) || !defined(TANGENTS) || !defined(UV_SETS) || !defined(COLORS) || \
    !defined(TEXTURES)
#error "define MATERIALS, NORMALS, TANGENTS, UV_SETS, COLORS and TEXTURES"
#endif

#if UV_SETS && !TEXTURES
#error "texture coordinates are for textures"
#endif

// Floats of a vertex in `attributes`, in this order; what there is none of takes no room.
#define NORMAL_AT 0
#define TANGENT_AT (NORMAL_AT + 3 * NORMALS)
#define UV_AT (TANGENT_AT + 4 * TANGENTS)
#define COLOR_AT (UV_AT + 2 * UV_SETS)
#define VERTEX_FLOATS (COLOR_AT + 4 * COLORS)

/// The arrays of a Geometry and of an Appearance.
typedef struct SceneArrays {
    global const float* positions;
    global const uint* triangles;
    global const MeshRange* meshes;
    global const InstanceRecord* instances;
    global const float* attributes;
    global const uint* triangle_materials;
    global const MaterialRecord* materials;
    global const TextureRecord* textures;
    global const uint* texels;
} SceneArrays;

// The parameters of a kernel that shades, and the SceneArrays of them.
#define SCENE_PARAMETERS                                                                                               \
    global const float *positions, global const uint *triangles, global const MeshRange *meshes,                       \
        global const InstanceRecord *instances, global const float *attributes, global const uint *triangle_materials, \
        global const MaterialRecord *materials, global const TextureRecord *textures, global const uint *texels
#define SCENE_ARRAYS \
    { positions, triangles, meshes, instances, attributes, triangle_materials, materials, textures, texels }

#endif
