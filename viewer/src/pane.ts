import * as THREE from "three/build/three.module.js";

import { Boxes } from "./boxes";
import { Kind, SceneData, World, indicesOf } from "./data";
import { litMaterial } from "./materials";
import { Surface } from "./surface";
import { smoothed, tubes } from "./tube";

export type SurfaceMode = "solid" | "glass" | "off";

interface Theme { surface: number; inner: number; cap: number; line: number; ghost: number; }
const THEMES: { [name: string]: Theme } = {
  light: { surface: 0xdcdfe5, inner: 0xb98fd0, cap: 0xf3efe4, line: 0x3c434f, ghost: 0.13 },
  dark: { surface: 0x6b7280, inner: 0xb98fd0, cap: 0x3a3f4a, line: 0xb8c0cc, ghost: 0.10 },
};

/** What is under the mouse. */
export interface Hit { label: string; at: THREE.Vector3; distance: number; }

interface Labelled { label: string; kind: number; points: Float32Array; radius: number; }

/** One scene: what is drawn of it, and what is in it. */
export class Pane {
  readonly scene = new THREE.Scene();
  readonly box = new THREE.Box3();
  readonly boxes: Boxes[];
  readonly kinds: Kind[];
  readonly countOfKind: number[];
  private readonly surfaces: Surface[] = [];
  private readonly lines: THREE.LineSegments[] = [];
  private readonly cutLines: THREE.LineSegments[] = [];
  private readonly ofKind: THREE.Object3D[][];
  private readonly labelled: Labelled[] = [];
  private readonly materials = new Map<string, THREE.Material[]>();

  constructor(world: World, readonly data: SceneData) {
    const positions = (points: string) => world.positionsOf(data, points);
    const origin = new THREE.Vector3(...world.originOf(data));
    const extent = new THREE.Vector3(...data.extent.map((x) => world.lengthOf(x)));
    this.box.set(origin, origin.clone().add(extent));
    const radius = 0.0042 * Math.max(extent.x, extent.y, extent.z);
    this.kinds = data.kinds;

    for (const { name, isSolid, isOnlyOnCut, points, triangles } of data.surfaces) {
      const surface = new Surface(name, isSolid, isOnlyOnCut, positions(points), indicesOf(triangles), extent.length());
      this.surfaces.push(surface);
      this.scene.add(...surface.objects);
    }
    for (const lines of data.lines) {
      const geometry = new THREE.BufferGeometry();
      geometry.setAttribute("position", new THREE.BufferAttribute(positions(lines.points), 3));
      geometry.setIndex(new THREE.BufferAttribute(indicesOf(lines.segments), 1));
      const drawn = new THREE.LineSegments(geometry, new THREE.LineBasicMaterial());
      drawn.name = lines.name;
      this.lines.push(drawn);
      if (lines.isCut) this.cutLines.push(drawn);
      this.scene.add(drawn);
    }
    this.boxes = data.boxes.map((boxes) => new Boxes(world, data, boxes));
    for (const boxes of this.boxes) this.scene.add(boxes.mesh);

    const curves = data.curves.map((curve) => ({ ...curve, points: smoothed(positions(curve.points)), radius }));
    const markers = data.markers.map((marker) => {
      const isOnCurve = data.curves.length > 0;
      return { ...marker, points: positions(marker.points), radius: (isOnCurve ? 1.9 : 2.4) * radius };
    });
    this.labelled.push(...markers, ...curves);
    this.countOfKind = data.kinds.map((_, kind) => this.labelled.filter((one) => one.kind === kind).length);
    this.ofKind = data.kinds.map((kind, index) => {
      const geometries: THREE.BufferGeometry[] = [];
      const ofThis = curves.filter((curve) => curve.kind === index);
      if (ofThis.length) geometries.push(tubes(ofThis.map((curve) => curve.points), radius));
      const objects: THREE.Object3D[] = geometries.flatMap((geometry) => this.solidAndShine(geometry, kind.color));
      const ball = new THREE.SphereBufferGeometry(1, 16, 12);
      for (const marker of markers.filter((one) => one.kind === index)) {
        for (const drawn of this.solidAndShine(ball, kind.color)) {
          drawn.position.fromArray(marker.points);
          drawn.scale.setScalar(marker.radius);
          objects.push(drawn);
        }
      }
      if (objects.length) this.scene.add(...objects);
      return objects;
    });
  }

  /** Something that is also seen through what hides it, faintly. */
  private solidAndShine(geometry: THREE.BufferGeometry, color: string): THREE.Mesh[] {
    let pair = this.materials.get(color);
    if (!pair) {
      pair = [
        litMaterial(true),
        new THREE.MeshBasicMaterial({ color, transparent: true, opacity: 0.3, depthFunc: THREE.GreaterDepth, depthWrite: false }),
      ];
      (pair[0] as THREE.ShaderMaterial).uniforms.color.value.set(color);
      this.materials.set(color, pair);
    }
    return pair.map((material, i) => {
      const mesh = new THREE.Mesh(geometry, material);
      mesh.renderOrder = i === 0 ? 0 : 6;
      return mesh;
    });
  }

  /** Names of what may be shown or hidden by name: all but what the surface mode is for. */
  names(): string[] {
    return [...this.surfaces.slice(1).map((surface) => surface.name), ...this.lines.map((lines) => lines.name)];
  }

  showName(name: string, isShown: boolean): void {
    for (const surface of this.surfaces.slice(1)) if (surface.name === name) surface.isShown = isShown;
    for (const lines of this.lines) if (lines.name === name) lines.visible = isShown;
  }

  showKind(kind: number, isShown: boolean): void {
    for (const object of this.ofKind[kind]) object.visible = isShown;
  }

  /** The half of `plane` to which its normal points is kept; without a plane all is. */
  cutBy(plane: THREE.Plane | null): void {
    for (const surface of this.surfaces) surface.cutBy(plane);
    for (const lines of this.cutLines) {
      const material = lines.material as THREE.LineBasicMaterial;
      material.clippingPlanes = plane ? [plane] : [];
      material.needsUpdate = true;
    }
  }

  show(isCut: boolean, mode: SurfaceMode, themeName: string): void {
    const theme = THEMES[themeName];
    this.surfaces.forEach((surface, i) => {
      const isMain = i === 0;
      surface.show(isCut, {
        isShown: isMain ? mode !== "off" : surface.isShown,
        isGlass: isMain && mode === "glass",
        color: isMain ? theme.surface : theme.inner,
        ghost: isMain ? theme.ghost : 2.5 * theme.ghost,
        cap: theme.cap,
        line: theme.line,
      });
    });
    for (const lines of this.lines) (lines.material as THREE.LineBasicMaterial).color.set(theme.line);
  }

  /** The nearest curve or marker within `reach` pixels of x, y in a view of so many pixels. */
  pick(camera: THREE.Camera, width: number, height: number, x: number, y: number, reach: number): Hit | null {
    const e = new THREE.Matrix4().multiplyMatrices(camera.projectionMatrix, camera.matrixWorldInverse).elements;
    let best: Hit | null = null;
    const offer = (distance: number, label: string, points: Float32Array, i: number) => {
      if (distance < (best ? best.distance : reach)) best = { label, distance, at: new THREE.Vector3().fromArray(points, i) };
    };
    for (const { label, kind, points, radius } of this.labelled) {
      if (!this.ofKind[kind].some((object) => object.visible)) continue;
      let lastX = NaN, lastY = NaN;
      for (let i = 0; i < points.length; i += 3) {
        const px = points[i], py = points[i + 1], pz = points[i + 2];
        const w = e[3] * px + e[7] * py + e[11] * pz + e[15];
        if (w <= 0) { lastX = NaN; continue; }
        const sx = ((e[0] * px + e[4] * py + e[8] * pz + e[12]) / w + 1) / 2 * width;
        const sy = (1 - (e[1] * px + e[5] * py + e[9] * pz + e[13]) / w) / 2 * height;
        const thick = e[5] * radius / w * height / 2;  // of the tube or ball, in pixels
        if (points.length === 3) {
          offer(Math.max(0, Math.hypot(x - sx, y - sy) - Math.abs(thick) - 2), label, points, i);
        } else if (!isNaN(lastX)) {
          const dx = sx - lastX, dy = sy - lastY;
          const t = Math.min(1, Math.max(0, ((x - lastX) * dx + (y - lastY) * dy) / (dx * dx + dy * dy || 1)));
          offer(Math.hypot(x - lastX - t * dx, y - lastY - t * dy), label, points, i);
        }
        lastX = sx;
        lastY = sy;
      }
    }
    return best;
  }
}
