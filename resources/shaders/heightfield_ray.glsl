// SPDX-License-Identifier: GPL-3.0-or-later
// Rays in the heightfield, in float: core/heightfield/HeightfieldTracer.h in GLSL, whose solids and
// whose order of cells these are. What rounding makes of a border may differ, so that a ray through
// an edge of a column may end beside it.
//
// All positions are relative to P, a point of the project near to the rays, so that cells near to
// it lie where they are to a hundredth of a millimetre. The tables: core/gpu/reflection/
// HeightfieldTable.h.

layout(binding = 6) uniform sampler2D fieldHeights;   // level k: maxima of 2^k x 2^k cells, metres
layout(binding = 7) uniform usampler2D fieldHollows;  // first row of a cell's stretches, plus one
layout(binding = 8) uniform samplerBuffer fieldStretches;  // low, high; from below; ends at +inf

uniform vec2 fieldFrom;     // the grid's south-west corner
uniform float fieldBase;    // height of P
uniform float fieldTop;     // of the highest column, above P
uniform float cellSize;     // metres
uniform ivec2 fieldCells;   // columns, rows
uniform bool fieldHasHollows;

const float kRayMiss = uintBitsToFloat(0x7f800000u);

// Where a ray meets one of a hollow column's stretches during [enter, leave); else no hit.
float hitInHollow(int row, float height, float rise, float enter, float leave) {
    float at = height + enter * rise;
    float below = -kRayMiss;
    for (;; ++row) {
        vec2 stretch = texelFetch(fieldStretches, row).rg - fieldBase;
        if (at >= stretch.x && at <= stretch.y) {
            return enter;
        }
        if (stretch.x > at) {  // the first one above, or the end
            float next = rise < 0.0 ? below : stretch.x;
            float t = rise == 0.0 ? kRayMiss : (next - height) / rise;
            return t < leave ? t : kRayMiss;
        }
        below = stretch.y;
    }
}

// The ray's parameter where it meets a solid, +infinity where it meets none.
float traceHeightfield(vec3 origin, vec3 direction) {
    vec2 heading = mix(direction.xy, vec2(1e-20), equal(direction.xy, vec2(0.0)));
    vec2 inverse = 1.0 / heading;
    vec2 first = (fieldFrom - origin.xy) * inverse;
    vec2 last = (fieldFrom + cellSize * vec2(fieldCells) - origin.xy) * inverse;
    vec2 entered = min(first, last);
    vec2 left = max(first, last);
    float t = max(0.0, max(entered.x, entered.y));
    float end = min(left.x, left.y);
    if (!(t < end)) {
        return kRayMiss;
    }
    bvec2 forward = greaterThan(heading, vec2(0.0));
    vec2 start = (origin.xy + t * heading - fieldFrom) / cellSize;
    ivec2 cell = clamp(ivec2(floor(start)), ivec2(0), fieldCells - 1);
    int top = textureQueryLevels(fieldHeights) - 1;
    int level = min(2, top);
    int most = 4 * (fieldCells.x + fieldCells.y) + 64;
    for (int k = 0; k < most; ++k) {
        ivec2 block = cell >> level;
        ivec2 ahead = (block + ivec2(forward)) << level;
        vec2 crossing = (fieldFrom + cellSize * vec2(ahead) - origin.xy) * inverse;
        float leave = max(t, min(crossing.x, crossing.y));
        float high = texelFetch(fieldHeights, block, level).r - fieldBase;
        float enterHeight = origin.z + t * direction.z;
        float leaveHeight = origin.z + leave * direction.z;
        if (min(enterHeight, leaveHeight) <= high) {
            if (level > 0) {
                --level;
                continue;
            }
            uint hollow = fieldHasHollows ? texelFetch(fieldHollows, cell, 0).r : 0u;
            if (hollow > 0u) {
                float hit = hitInHollow(int(hollow) - 1, origin.z, direction.z, t, leave);
                if (!isinf(hit)) {
                    return hit;
                }
            } else {
                return enterHeight <= high ? t : (high - origin.z) / direction.z;
            }
        }
        if (leave >= end || (direction.z >= 0.0 && leaveHeight > fieldTop)) {
            return kRayMiss;
        }
        // Into the next block; along the other axis the ray stays within this one's cells.
        ivec2 lower = block << level;
        ivec2 upper = lower + (1 << level) - 1;
        ivec2 beyond = mix(lower - 1, upper + 1, forward);
        ivec2 here = clamp(ivec2(floor((origin.xy + leave * heading - fieldFrom) / cellSize)), lower,
                           upper);
        ivec2 next = ivec2(crossing.x <= crossing.y ? beyond.x : here.x,
                           crossing.y <= crossing.x ? beyond.y : here.y);
        if (any(lessThan(next, ivec2(0))) || any(greaterThanEqual(next, fieldCells))) {
            return kRayMiss;
        }
        if (level < top && (next >> (level + 1)) != (cell >> (level + 1))) {
            ++level;
        }
        cell = next;
        t = leave;
    }
    return kRayMiss;
}
