// SPDX-License-Identifier: GPL-3.0-or-later
#version 450 core
// A probe: a ball in the colour of its state, with a mark that says the same by shape.
//   missing: a hollow ball     fresh: a full ball        stale: a broken ring around it
//   baking: three quarters of a ring                     refused: a cross over it
// A preview mirrors the probe's own map.

#include "overlay_depth.glsl"

layout(binding = 1) uniform samplerCubeArray rem;

uniform int cube;  // element of rem; -1 = no preview
uniform vec3 center;
uniform float radius;
uniform vec3 right;
uniform vec3 up;
uniform vec3 color;
uniform int state;  // ProbeState
uniform bool selected;
uniform bool hovered;
uniform float exposure;

in vec2 place;

layout(location = 0) out vec4 drawn;

const int kMissing = 0;
const int kStale = 2;
const int kBaking = 3;
const int kRefused = 4;
const float kTurn = 6.2831853;

float inside(float distance) {
    return clamp(0.5 - distance / max(fwidth(distance), 1e-5), 0.0, 1.0);
}

vec3 display(vec3 radiance) {
    vec3 c = clamp(radiance * exposure, 0.0, 1.0);
    return mix(1.055 * pow(c, vec3(1.0 / 2.4)) - 0.055, 12.92 * c,
               lessThanEqual(c, vec3(0.0031308)));
}

// Paints over what is there.
void paint(inout vec4 under, vec3 tone, float alpha) {
    under.rgb = mix(under.rgb, tone, alpha);
    under.a = alpha + under.a * (1.0 - alpha);
}

void main() {
    float r = length(place);
    float turn = fract(atan(place.y, place.x) / kTurn + 0.25);
    vec3 towardsEye = -normalize(center);
    vec3 normal = normalize(place.x * right + place.y * up +
                            sqrt(max(1.0 - r * r, 0.0)) * towardsEye);
    vec4 picture = vec4(0.0);
    float ball = inside(r - 1.0);

    // A dark rim sets all marks off from bright streets.
    paint(picture, vec3(0.02), 0.75 * inside(abs(r - 1.0) - 0.10));
    if (cube >= 0) {
        vec3 direction = reflect(normalize(center + radius * normal), normal);
        paint(picture, display(textureLod(rem, vec4(direction, float(cube)), 0.0).rgb), ball);
        paint(picture, color, inside(abs(r - 1.04) - 0.05));
    } else if (state == kMissing) {
        paint(picture, color, inside(abs(r - 0.86) - 0.14));
        paint(picture, color, 0.18 * ball);
    } else {
        float light = 0.62 + 0.38 * dot(normal, normalize(vec3(0.3, -0.2, 0.9)));
        float shine = pow(max(dot(normal, normalize(up + towardsEye - 0.4 * right)), 0.0), 40.0);
        paint(picture, color * light + 0.5 * shine, ball);
    }
    float ring = inside(abs(r - 1.36) - 0.12);
    float rim = inside(abs(r - 1.36) - 0.19);
    if (state == kStale) {
        float dash = step(0.4, fract(turn * 8.0));
        paint(picture, vec3(0.02), 0.7 * rim * dash);
        paint(picture, color, ring * dash);
    } else if (state == kBaking) {
        float arc = step(turn, 0.75);
        paint(picture, vec3(0.02), 0.7 * rim * arc);
        paint(picture, color, ring * arc);
    } else if (state == kRefused) {
        float cross = min(abs(place.x - place.y), abs(place.x + place.y));
        paint(picture, vec3(1.0), inside(max(cross - 0.22, r - 0.72)));
    }
    if (selected || hovered) {
        float halo = abs(r - 1.7) - (selected ? 0.11 : 0.06);
        paint(picture, vec3(0.02), 0.7 * inside(halo - 0.06));
        paint(picture, selected ? vec3(1.0, 0.78, 0.1) : vec3(1.0), inside(halo));
    }
    picture.a *= visibility(center, radius);
    drawn = picture;
}
