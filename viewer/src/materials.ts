import * as THREE from "three/build/three.module.js";

const VERTEX = `
uniform vec4 plane;
varying vec3 at; varying vec3 across; varying float height;
void main() {
  vec4 world = modelMatrix * vec4(position, 1.0);
  vec4 p = viewMatrix * world;
  at = p.xyz;
  #ifdef SMOOTH
    across = normalMatrix * normal;
  #endif
  height = dot(plane.xyz, world.xyz) + plane.w;
  gl_Position = projectionMatrix * p;
}`;
const FRAGMENT = `
uniform vec3 color; uniform float opacity;
varying vec3 at; varying vec3 across; varying float height;
void main() {
  if (height < 0.0) discard;
  #ifdef SMOOTH
    vec3 n = normalize(across);
  #else
    vec3 n = normalize(cross(dFdx(at), dFdy(at)));
  #endif
  gl_FragColor = vec4(color * (0.66 + 0.36 * max(0.0, dot(n, vec3(0.35, 0.5, 0.79)))), opacity);
}`;

/**
 * Lit over the viewer's shoulder, and cut away behind `plane`. Small, as programs and pixels are dear without a graphics
 * card; so three's own lights are left out.
 */
export function litMaterial(isSmooth: boolean, parameters: THREE.ShaderMaterialParameters = {}): THREE.ShaderMaterial {
  const material = new THREE.ShaderMaterial({
    vertexShader: VERTEX,
    fragmentShader: FRAGMENT,
    defines: isSmooth ? { SMOOTH: "" } : {},
    uniforms: {
      color: { value: new THREE.Color() },
      opacity: { value: 1 },
      plane: { value: new THREE.Vector4(0, 0, 0, 1) },
    },
    ...parameters,
  });
  material.extensions.derivatives = !isSmooth;
  return material;
}
