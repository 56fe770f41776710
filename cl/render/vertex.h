// SPDX-License-Identifier: MIT
// Where paths meet surfaces, one per lane. Macros: render/shading_point.h and render/bsdf.h.
#ifndef BOXWOOD_RENDER_VERTEX_H
#define BOXWOOD_RENDER_VERTEX_H
#include "render/bsdf.h"
#include "render/pixel_beam.h"
#include "render/tangents.h"

/// A surface, the frame of the normal for shading, and the way back in it.
typedef struct Vertex {
    ShadingPoint point;
    Vector tangent, bitangent;
    Vector origin; ///< Of rays that leave.
    Vector wo;
    Bsdf bsdf;
} Vertex;

INLINE void into_frame(const Vertex* vertex, const Vector* v, Vector* result) {
    const Vector r = {dot3(v, &vertex->tangent), dot3(v, &vertex->bitangent), dot3(v, &vertex->point.normal)};
    *result = r;
}

INLINE void out_of_frame(const Vertex* vertex, const Vector* v, Vector* result) {
    Vector r = vertex->tangent;
    scale3(v->x, &r);
    add_scaled3(v->y, &vertex->bitangent, &r);
    add_scaled3(v->z, &vertex->point.normal, &r);
    *result = r;
}

/// The beam of a cone of `width`, not sharp.
INLINE void cone_beam(const Vector* direction, real width, Beam* beam) {
    tangents_of(direction, &beam->x, &beam->y);
    scale3(width, &beam->x);
    scale3(width, &beam->y);
    beam->exact_light = beam->sharp = (mask)(0);
}

/// From `point` and the rays' `direction`, which is normalised.
INLINE void make_vertex(const Vector* direction, Vertex* vertex) {
    const ShadingPoint* point = &vertex->point;
    tangents_of(&point->normal, &vertex->tangent, &vertex->bitangent);
    surface_origin(&point->surface, &vertex->origin);
#if NORMALS
    add3(&vertex->origin, &point->lift, &vertex->origin);
#endif
    Vector back = *direction;
    scale3((real)(-1.0f), &back);
    into_frame(vertex, &back, &vertex->wo);
    make_bsdf(&point->base_color, point->metallic, point->roughness, point->specular, &vertex->wo, &vertex->bsdf);
}

/// Whether directions lead away from surfaces: from triangles, or, where these stand for a smooth surface above, from
/// that.
INLINE mask leads_away(const Vertex* vertex, const Vector* direction) {
    mask away = dot3(direction, &vertex->point.surface.normal) > 0.0f;
#if NORMALS
    const mask lifted = largest3(&vertex->point.lift) > 0.0f, above = dot3(direction, &vertex->point.smooth) > 0.0f;
    away |= lifted & above;
#endif
    return away;
}

/// Whether triangles have an area, and so a normal.
INLINE mask is_solid(const Surface* surface) { return largest3(&surface->normal) > 0.0f; }

#endif
