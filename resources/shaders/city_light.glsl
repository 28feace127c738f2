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
    vec4 ambientHalf;     // xy: half a texel; z: reciprocal of the texture's depth; w: light of white
    vec4 shadowAxes[3];   // right, up and away from the sun; w: nothing, nothing, highest depth
    vec4 shadowDepth;     // per metre: x of the city's maps, y of the vehicles'; z: their highest
    vec4 shadowSquare[kCascades + 1];  // x: maps per metre, yz: where the origin lies in the map,
                                       // w: metres per texel; the last: vehicles, w 0 = none
    vec4 shadowLayers;    // of sunShadows, a cascade each
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
    vec3 root = textureLod(ambientLattice, vec3(at.xy, depth), 0.0).rgb;
    return root * root * ambientHalf.w;
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

    vec3 place = vec3(dot(position, shadowAxes[0].xyz), dot(position, shadowAxes[1].xyz),
                      dot(position, shadowAxes[2].xyz));
    vec3 shift = vec3(dot(off, shadowAxes[0].xyz), dot(off, shadowAxes[1].xyz),
                      dot(off, shadowAxes[2].xyz));
    vec4 square = shadowSquare[kCascades - 1];
    float layer = shadowLayers[kCascades - 1];
    for (int i = kCascades - 2; i >= 0; --i) {
        vec2 at = abs(place.xy * shadowSquare[i].x + shadowSquare[i].yz - 0.5);
        bool inside = max(at.x, at.y) < 0.497;
        square = inside ? shadowSquare[i] : square;
        layer = inside ? shadowLayers[i] : layer;
    }
    vec3 lifted = place + square.w * shift;
    vec2 at = lifted.xy * square.x + square.yz;
    float depth = clamp((lifted.z + shadowAxes[2].w) * shadowDepth.x, 0.0, 1.0);
    float lit = texture(sunShadows, vec4(at, layer, depth));
    lit = all(lessThan(abs(at - 0.5), vec2(0.5))) ? lit : 1.0;

    square = shadowSquare[kCascades];
    lifted = place + square.w * shift;
    vec3 body = vec3(lifted.xy * square.x + square.yz, (lifted.z + shadowDepth.z) * shadowDepth.y);
    bool near = square.w > 0.0 && all(lessThan(abs(body - 0.5), vec3(0.5)));
    return near ? min(lit, texture(vehicleShadows, body)) : lit;
}

/// Irradiance / pi of the sun on a surface with this unit normal.
vec3 sunLight(vec3 position, vec3 normal) {
    float cosine = dot(normal, sunDirection.xyz);
    float visible = sunVisibility(position, cosine > 0.0 ? normal : -normal);
    return sunRadiance.rgb * (max(cosine, 0.0) * mix(1.0, visible, sunRadiance.w));
}
