"""The shader of the overlay: reflection stripes or curvature colours."""

from __future__ import annotations

from typing import Any

import gpu

_VERTEX = """
void main()
{
  world_position = position;
  world_normal = normal;
  mean_curvature = curvature;
  gl_Position = view_projection * vec4(position, 1.0);
  // In front of the mesh itself, which the viewport has drawn already.
  gl_Position.z -= 2e-5 * gl_Position.w;
}
"""

_FRAGMENT = """
vec3 towards_eye()
{
  return normalize(eye.w > 0.5 ? eye.xyz - world_position : eye.xyz);
}

// Rings of light far away around the axis, mirrored in the surface: their reflections are continuous
// where the surface is G1, and smooth where it is G2. `lights.w` of them from pole to pole.
vec4 zebra(vec3 n)
{
  float angle = acos(clamp(dot(reflect(-towards_eye(), n), lights.xyz), -1.0, 1.0));
  float wave = sin(2.0 * angle * lights.w);
  float soft = max(fwidth(wave), 1e-4);
  return vec4(vec3(mix(0.02, 0.95, smoothstep(-soft, soft, wave))), look.z);
}

// Red: bulges outwards, white: flat on average, blue: caves in.
vec4 heat(float h, vec3 n)
{
  float light = 0.6 + 0.4 * abs(dot(n, towards_eye()));
  float t = clamp(h / look.y, -1.0, 1.0);
  vec3 end = t < 0.0 ? vec3(0.10, 0.30, 0.85) : vec3(0.85, 0.12, 0.10);
  return vec4(light * mix(vec3(0.96), end, abs(t)), look.z);
}

void main()
{
  vec3 n = normalize(world_normal);
  colour = look.x > 0.5 ? heat(mean_curvature, n) : zebra(n);
}
"""

# No more than the 128 bytes that every GPU has room for.
_CONSTANTS = (
    ("MAT4", "view_projection"),
    ("VEC4", "eye"),  # point, 1; without perspective direction, 0
    ("VEC4", "lights"),  # unit axis, number of rings
    ("VEC4", "look"),  # 1 for curvature, curvature with full colour, opacity, unused
)


def make_shader() -> Any:
    """Compile the shader; needs a GPU context."""
    between = gpu.types.GPUStageInterfaceInfo("fairing_overlay")
    between.smooth("VEC3", "world_position")
    between.smooth("VEC3", "world_normal")
    between.smooth("FLOAT", "mean_curvature")
    info = gpu.types.GPUShaderCreateInfo()
    for kind, name in _CONSTANTS:
        info.push_constant(kind, name)
    for location, (kind, name) in enumerate((("VEC3", "position"), ("VEC3", "normal"), ("FLOAT", "curvature"))):
        info.vertex_in(location, kind, name)
    info.vertex_out(between)
    info.fragment_out(0, "VEC4", "colour")
    info.vertex_source(_VERTEX)
    info.fragment_source(_FRAGMENT)
    return gpu.shader.create_from_info(info)
