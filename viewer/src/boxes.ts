import * as THREE from "three/build/three.module.js";

import { BoxesData, SceneData, World, numbersOf, rotationsOf } from "./data";

/** About so many are shown at once, larger for it: more are a haze, and slow to draw without a graphics card. */
const WANTED = { onArea: 1200, inVolume: 4000 };
const MAX_SHOWN = 8000;

export type Where = "cut" | "everywhere" | "off";
export const SCALE = ["#2a9d8f", "#e9c46a", "#d1495b"].map((color) => new THREE.Color(color));

const VERTEX = `
attribute vec3 center; attribute vec4 turn; attribute float side; attribute float share;
uniform vec3 shape; uniform vec3 low; uniform vec3 middle; uniform vec3 high; uniform bool byAxis;
varying vec3 color; varying vec2 face;
vec3 turned(vec3 v) { return v + 2.0 * cross(turn.xyz, cross(turn.xyz, v) + turn.w * v); }
void main() {
  vec3 n = turned(normal);
  vec4 p = viewMatrix * vec4(center + side * turned(position * shape), 1.0);
  vec3 paint = share < 0.5 ? mix(low, middle, 2.0 * share) : mix(middle, high, 2.0 * share - 1.0);
  if (byAxis) { vec3 a = n * n; paint = a.x * vec3(0.89, 0.34, 0.34) + a.y * vec3(0.30, 0.69, 0.42) + a.z * vec3(0.31, 0.51, 0.93); }
  float light = dot(normalize((viewMatrix * vec4(n, 0.0)).xyz), normalize(vec3(0.35, 0.5, 0.8)));
  color = paint * (0.62 + 0.45 * max(light, 0.0));
  face = uv;
  gl_Position = projectionMatrix * p;
}`;
const FRAGMENT = `
varying vec3 color; varying vec2 face;
void main() {
  vec2 border = min(face, 1.0 - face);
  gl_FragColor = vec4(color * (min(border.x, border.y) < 0.06 ? 0.62 : 1.0), 1.0);
}`;

/** The boxes of one SceneBoxes: of all, those are drawn that are to be seen. */
export class Boxes {
  readonly mesh: THREE.Mesh;
  /** The value that 98 % of all do not exceed. */
  readonly highValue: number;
  readonly areFlat: boolean;
  readonly valueName: string;
  shown = 0;
  private readonly centers: Float32Array;
  private readonly rotations: Float32Array;
  private readonly spacings: Float32Array;
  private readonly values: Float32Array;
  private readonly geometry = new THREE.InstancedBufferGeometry();
  private readonly material: THREE.ShaderMaterial;

  constructor(world: World, scene: SceneData, data: BoxesData) {
    this.areFlat = data.areFlat;
    this.valueName = data.valueName;
    this.centers = world.positionsOf(scene, data.points);
    this.rotations = rotationsOf(data.rotations);
    this.spacings = numbersOf({ ...data.spacings, largest: world.lengthOf(data.spacings.largest) });
    this.values = numbersOf(data.values);
    const sorted = this.values.slice().sort();
    this.highValue = sorted.length ? sorted[Math.floor(0.98 * (sorted.length - 1))] : 0;

    const box = new THREE.BoxBufferGeometry(1, 1, 1);
    this.geometry.setIndex(box.index as THREE.BufferAttribute);
    for (const name of ["position", "normal", "uv"]) this.geometry.setAttribute(name, box.attributes[name]);
    const room = Math.min(MAX_SHOWN, this.spacings.length);
    for (const [name, size] of [["center", 3], ["turn", 4], ["side", 1], ["share", 1]] as [string, number][]) {
      const attribute = new THREE.InstancedBufferAttribute(new Float32Array(size * room), size);
      attribute.setUsage(THREE.DynamicDrawUsage);
      this.geometry.setAttribute(name, attribute);
    }
    this.material = new THREE.ShaderMaterial({
      vertexShader: VERTEX,
      fragmentShader: FRAGMENT,
      uniforms: {
        shape: { value: data.areFlat ? new THREE.Vector3(0.66, 0.66, 0.1) : new THREE.Vector3(0.5, 0.5, 0.5) },
        low: { value: SCALE[0] }, middle: { value: SCALE[1] }, high: { value: SCALE[2] },
        byAxis: { value: false },
      },
    });
    this.mesh = new THREE.Mesh(this.geometry, this.material);
    this.mesh.frustumCulled = false;
  }

  get total(): number { return this.spacings.length; }

  colorByAxis(byAxis: boolean): void { this.material.uniforms.byAxis.value = byAxis; }

  /**
   * Of a solid those that stand on the cut, in the half that is taken away; or all. `high` is the value at the end of
   * the scale.
   */
  show(where: Where, plane: THREE.Plane | null, high: number): void {
    const { centers, spacings } = this;
    let chosen: number[] = [];
    if (where === "cut" && plane && !this.areFlat) {
      const { x, y, z } = plane.normal;
      for (let i = 0; i < spacings.length; ++i) {
        const height = -(x * centers[3 * i] + y * centers[3 * i + 1] + z * centers[3 * i + 2] + plane.constant);
        if (height >= 0 && height < 0.8 * spacings[i]) chosen.push(i);
      }
    } else if (where !== "off") {
      chosen = Array.from(spacings.keys());
    }
    const apart = this.thinOut(chosen, where === "everywhere" && !this.areFlat ? 3 : 2);
    chosen = chosen.slice(0, MAX_SHOWN);
    this.shown = chosen.length;
    const attributes = this.geometry.attributes as { [name: string]: THREE.BufferAttribute };
    const array = (name: string) => attributes[name].array as Float32Array;
    const center = array("center"), turn = array("turn"), side = array("side"), share = array("share");
    for (let k = 0; k < this.shown; ++k) {
      const i = chosen[k];
      center.set(centers.subarray(3 * i, 3 * i + 3), 3 * k);
      turn.set(this.rotations.subarray(4 * i, 4 * i + 4), 4 * k);
      side[k] = Math.max(spacings[i], apart);
      share[k] = high > 0 ? Math.min(1, this.values[i] / high) : 0;
    }
    for (const name of ["center", "turn", "side", "share"]) attributes[name].needsUpdate = true;
    this.geometry.maxInstancedCount = this.shown;
    this.mesh.visible = this.shown > 0;
  }

  /** Leaves one in every cell of a grid where there are too many; the size of the cells, or 0. */
  private thinOut(chosen: number[], dimension: 2 | 3): number {
    const wanted = dimension === 2 ? WANTED.onArea : WANTED.inVolume;
    if (chosen.length <= wanted) return 0;
    let measure = 0;
    for (const i of chosen) measure += this.spacings[i] ** dimension;
    const cell = (measure / wanted) ** (1 / dimension);
    const taken = new Set<number>();
    let kept = 0;
    for (const i of chosen) {
      const [x, y, z] = [0, 1, 2].map((k) => Math.floor(this.centers[3 * i + k] / cell) + 1e5);
      const key = x + 2e5 * (y + 2e5 * z);
      if (taken.has(key)) continue;
      taken.add(key);
      chosen[kept++] = i;
    }
    chosen.length = kept;
    return cell;
  }
}
