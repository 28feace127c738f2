// SPDX-License-Identifier: GPL-3.0-or-later
#version 450 core
// vertex: screen_triangle.vert.glsl
// Linear radiance to display values: core/environment/ImageMetrics toDisplay() in GLSL. The samples
// of a pixel are weighted by 1 / (1 + luminance), so that highlights leave smooth edges.

layout(binding = 0) uniform sampler2D radiance;
uniform int samplesPerEdge;
uniform float exposure;

layout(location = 0) out vec4 display;

vec3 srgbFromLinear(vec3 c) {
    vec3 curve = 1.055 * pow(c, vec3(1.0 / 2.4)) - 0.055;
    return mix(curve, 12.92 * c, lessThanEqual(c, vec3(0.0031308)));
}

void main() {
    ivec2 first = ivec2(gl_FragCoord.xy) * samplesPerEdge;
    vec3 sum = vec3(0.0);
    float weights = 0.0;
    for (int y = 0; y < samplesPerEdge; ++y) {
        for (int x = 0; x < samplesPerEdge; ++x) {
            vec3 c = texelFetch(radiance, first + ivec2(x, y), 0).rgb;
            float weight = 1.0 / (1.0 + dot(c, vec3(0.2126, 0.7152, 0.0722)));
            sum += weight * c;
            weights += weight;
        }
    }
    vec3 scaled = clamp(sum * (exposure / weights), 0.0, 1.0);
    display = vec4(srgbFromLinear(scaled), 1.0);
}
