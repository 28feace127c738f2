// SPDX-License-Identifier: GPL-3.0-or-later
// The light on the city and on all that stands in it: sun with shadows, soft light, sky.
// CityPass::bindLight() binds what is read here.

const int kCascades = 4;  // of the city's shadows; one more map holds those of vehicles

layout(std140, binding = 7) uniform CityLight {
    vec4 sunDirection;    // unit, towards the sun; w: how much artificial light is on, 0..1
    vec4 sunRadiance;     // irradiance / pi of a surface that faces the sun; w: 1 = there are shadows
    vec4 ambientOrigin;   // of the lattice, metres; w: its layers
    vec4 ambientScale;    // xy: texture coordinates per metre, z: layers per metre;
                          // w: metres off a surface at which its light is looked up
    vec4 ambientHalf;     // xy: half a texel; z: reciprocal of the texture's depth
    vec4 shadowTexel;     // metres per texel of each cascade
    vec4 vehicleShadow;   // x: metres per texel, 0 = none; y: 1 / texels along an edge
    mat4 shadow_from_project[kCascades + 1];  // texture coordinates and depth, 0..1
};

layout(binding = 10) uniform samplerCube skyCube;
layout(binding = 11) uniform sampler3D ambientLattice;
layout(binding = 12) uniform sampler2DArrayShadow sunShadows;
layout(binding = 13) uniform sampler2DShadow vehicleShadows;

vec3 skyRadiance(vec3 direction) {
    return textureLod(skyCube, direction, 0.0).rgb;
}

vec3 ambientSide(vec3 at, float side) {
    float depth = (side * ambientOrigin.w + at.z + 0.5) * ambientHalf.z;
    return textureLod(ambientLattice, vec3(at.xy, depth), 0.0).rgb;
}

/// Irradiance / pi of soft light on a surface with this unit normal (an ambient cube).
vec3 ambientLight(vec3 position, vec3 normal) {
    vec3 local = position + ambientScale.w * normal - ambientOrigin.xyz;
    vec3 at = vec3(clamp(local.xy * ambientScale.xy + ambientHalf.xy, ambientHalf.xy,
                         1.0 - ambientHalf.xy),
                   clamp(local.z * ambientScale.z, 0.0, ambientOrigin.w - 1.0));
    vec3 weight = normal * normal;
    vec3 side = vec3(lessThan(normal, vec3(0.0)));
    return weight.x * ambientSide(at, side.x) + weight.y * ambientSide(at, 2.0 + side.y) +
           weight.z * ambientSide(at, 4.0 + side.z);
}

/// The share of the sun that reaches a point of a surface; the normal faces the sun.
float sunVisibility(vec3 position, vec3 normal) {
    // Off the surface by what a texel spans across it, so that it does not shadow itself.
    float cosine = clamp(dot(normal, sunDirection.xyz), 0.0, 1.0);
    float slant = sqrt(1.0 - cosine * cosine);
    vec3 off = normal * (0.4 + 1.1 * slant) + 0.5 * sunDirection.xyz;

    int layer = kCascades - 1;
    for (int i = kCascades - 2; i >= 0; --i) {
        vec2 at = abs((shadow_from_project[i] * vec4(position, 1.0)).xy - 0.5);
        layer = max(at.x, at.y) < 0.497 ? i : layer;
    }
    vec3 lifted = position + shadowTexel[layer] * off;
    vec3 at = (shadow_from_project[layer] * vec4(lifted, 1.0)).xyz;
    bool inside = all(lessThan(abs(at.xy - 0.5), vec2(0.5)));
    float lit = texture(sunShadows, vec4(at.xy, float(layer), clamp(at.z, 0.0, 1.0)));
    lit = inside ? lit : 1.0;

    vec3 body = (shadow_from_project[kCascades] * vec4(position + vehicleShadow.x * off, 1.0)).xyz;
    bool near = vehicleShadow.x > 0.0 && all(lessThan(abs(body - 0.5), vec3(0.5)));
    float open = texture(vehicleShadows, vec3(body.xy, body.z));
    return near ? min(lit, open) : lit;
}

/// Irradiance / pi of the sun on a surface with this unit normal.
vec3 sunLight(vec3 position, vec3 normal) {
    float cosine = dot(normal, sunDirection.xyz);
    float visible = sunVisibility(position, cosine > 0.0 ? normal : -normal);
    return sunRadiance.rgb * (max(cosine, 0.0) * mix(1.0, visible, sunRadiance.w));
}
