import * as THREE from "three/build/three.module.js";

import { litMaterial } from "./materials";

export interface SurfaceLook { isShown: boolean; isGlass: boolean; color: number; ghost: number; cap: number; line: number; }

/** The two halves of a surface that the cut parts, and the cut itself where the surface is solid. */
export class Surface {
  readonly objects: THREE.Object3D[];
  isShown = true;
  private readonly kept: THREE.Mesh;
  private readonly ghost: THREE.Mesh;
  private readonly fan: THREE.Mesh;
  private readonly cap: THREE.Mesh;
  private readonly contour: THREE.LineSegments;
  private readonly heights: Float32Array;

  constructor(readonly name: string, private readonly isSolid: boolean, private readonly isOnlyOnCut: boolean,
              private readonly points: Float32Array, private readonly triangles: Uint32Array, private readonly extent: number) {
    const offset = { side: THREE.DoubleSide, polygonOffset: true, polygonOffsetFactor: 1, polygonOffsetUnits: 1 };
    const position = new THREE.BufferAttribute(points, 3);
    const half = (material: THREE.Material) => {
      const geometry = new THREE.BufferGeometry();
      geometry.setAttribute("position", position);
      const index = new THREE.BufferAttribute(new Uint32Array(triangles.length), 1);
      index.setUsage(THREE.DynamicDrawUsage);
      geometry.setIndex(index);
      const mesh = new THREE.Mesh(geometry, material);
      mesh.frustumCulled = false;
      return mesh;
    };
    this.kept = half(litMaterial(false, offset));
    this.ghost = half(litMaterial(false, { ...offset, transparent: true, depthWrite: false }));
    this.ghost.renderOrder = 5;
    this.heights = new Float32Array(points.length / 3);

    // The cut is filled by the even-odd rule: a fan of triangles over its contour turns the stencil over.
    this.fan = new THREE.Mesh(new THREE.BufferGeometry(), new THREE.MeshBasicMaterial({
      side: THREE.DoubleSide, depthWrite: false, depthTest: false, colorWrite: false,
      stencilWrite: true, stencilFunc: THREE.AlwaysStencilFunc,
      stencilFail: THREE.InvertStencilOp, stencilZFail: THREE.InvertStencilOp, stencilZPass: THREE.InvertStencilOp,
    } as THREE.MeshBasicMaterialParameters));
    this.fan.renderOrder = 1;
    this.cap = new THREE.Mesh(new THREE.PlaneBufferGeometry(1, 1), new THREE.MeshBasicMaterial({
      ...offset, stencilWrite: true, stencilRef: 0, stencilFunc: THREE.NotEqualStencilFunc,
      stencilFail: THREE.ZeroStencilOp, stencilZFail: THREE.ZeroStencilOp, stencilZPass: THREE.ZeroStencilOp,
    } as THREE.MeshBasicMaterialParameters));
    this.cap.renderOrder = 2;
    this.contour = new THREE.LineSegments(new THREE.BufferGeometry(), new THREE.LineBasicMaterial());
    for (const object of [this.fan, this.cap, this.contour]) object.frustumCulled = false;
    this.objects = [this.kept, this.ghost, this.fan, this.cap, this.contour];
  }

  /** The half of `plane` to which its normal points is kept; without a plane all is. */
  cutBy(plane: THREE.Plane | null): void {
    const { points, triangles, heights } = this;
    const normal = plane ? plane.normal : new THREE.Vector3();
    const constant = plane ? plane.constant : 1;
    for (let v = 0, i = 0; v < heights.length; ++v, i += 3) {
      heights[v] = normal.x * points[i] + normal.y * points[i + 1] + normal.z * points[i + 2] + constant;
    }
    const halves = [this.kept, this.ghost].map((mesh) => (mesh.geometry as THREE.BufferGeometry).index as THREE.BufferAttribute);
    const [kept, ghost] = halves.map((index) => index.array as Uint32Array);
    const contour: number[] = [];
    let numKept = 0, numGhost = 0;
    for (let t = 0; t < triangles.length; t += 3) {
      const a = triangles[t], b = triangles[t + 1], c = triangles[t + 2];
      const above = Number(heights[a] >= 0) + Number(heights[b] >= 0) + Number(heights[c] >= 0);
      if (above > 0) {
        kept[numKept++] = a; kept[numKept++] = b; kept[numKept++] = c;
      }
      if (above < 3) {
        ghost[numGhost++] = a; ghost[numGhost++] = b; ghost[numGhost++] = c;
      }
      if (above > 0 && above < 3) {
        this.addCrossing(a, b, contour);
        this.addCrossing(b, c, contour);
        this.addCrossing(c, a, contour);
      }
    }
    [numKept, numGhost].forEach((count, i) => {
      ([this.kept, this.ghost][i].geometry as THREE.BufferGeometry).setDrawRange(0, count);
      halves[i].updateRange.count = count;
      halves[i].needsUpdate = true;
    });
    const signs = [[this.kept, 1], [this.ghost, -1]] as [THREE.Mesh, number][];
    for (const [mesh, sign] of signs) {
      (mesh.material as THREE.ShaderMaterial).uniforms.plane.value.set(
        sign * normal.x, sign * normal.y, sign * normal.z, sign * constant);
    }
    this.setContour(new Float32Array(contour), plane);
  }

  /** Where the plane crosses the edge, if it does. */
  private addCrossing(a: number, b: number, contour: number[]): void {
    // From the smaller vertex, so that neighbours find the very same point.
    const [u, v] = a < b ? [a, b] : [b, a];
    const { points, heights } = this;
    if (heights[u] >= 0 === heights[v] >= 0) return;
    const share = heights[u] / (heights[u] - heights[v]);
    for (let i = 0; i < 3; ++i) contour.push(points[3 * u + i] + share * (points[3 * v + i] - points[3 * u + i]));
  }

  private setContour(contour: Float32Array, plane: THREE.Plane | null): void {
    const replace = (object: THREE.Mesh | THREE.LineSegments, positions: Float32Array) => {
      object.geometry.dispose();
      const geometry = new THREE.BufferGeometry();
      geometry.setAttribute("position", new THREE.BufferAttribute(positions, 3));
      object.geometry = geometry;
    };
    replace(this.contour, contour);
    if (!this.isSolid || !plane) return;
    const apex = contour.subarray(0, 3);
    const fan = new Float32Array(contour.length / 2 * 3);
    for (let i = 0, k = 0; i < contour.length; i += 6, k += 9) {
      fan.set(apex, k);
      fan.set(contour.subarray(i, i + 6), k + 3);
    }
    replace(this.fan, fan);
    this.cap.position.fromArray(contour.length ? apex : [0, 0, 0]);
    this.cap.lookAt(this.cap.position.clone().add(plane.normal));
    this.cap.scale.setScalar(4 * this.extent);
  }

  show(isCut: boolean, look: SurfaceLook): void {
    const kept = this.kept.material as THREE.ShaderMaterial;
    const ghost = this.ghost.material as THREE.ShaderMaterial;
    kept.uniforms.color.value.set(look.color);
    ghost.uniforms.color.value.set(look.color);
    kept.uniforms.opacity.value = look.isGlass ? 0.3 : 1;
    ghost.uniforms.opacity.value = look.ghost;
    kept.transparent = look.isGlass;
    kept.depthWrite = !look.isGlass;
    this.kept.renderOrder = look.isGlass ? 4 : 0;
    (this.cap.material as THREE.MeshBasicMaterial).color.set(look.cap);
    (this.contour.material as THREE.LineBasicMaterial).color.set(look.line);
    this.kept.visible = look.isShown && !this.isOnlyOnCut;
    this.ghost.visible = this.kept.visible && isCut;
    this.contour.visible = look.isShown && isCut;
    this.fan.visible = this.cap.visible = look.isShown && isCut && this.isSolid && !look.isGlass;
  }
}
