import * as THREE from "three/build/three.module.js";

const SIDES = 10;

/** A polyline's corners cut off a little, ends kept: curves step from triangle to triangle of the mesh. */
export function smoothed(points: Float32Array, rounds = 3): Float32Array {
  const last = points.length - 3;
  const isLoop = [0, 1, 2].every((i) => points[i] === points[last + i]);
  let current = points;
  for (let round = 0; round < rounds; ++round) {
    const next = current.slice();
    for (let i = 3; i < last; ++i) next[i] = (current[i - 3] + 2 * current[i] + current[i + 3]) / 4;
    if (isLoop && last > 3) {
      for (let i = 0; i < 3; ++i) next[i] = next[last + i] = (current[last - 3 + i] + 2 * current[i] + current[3 + i]) / 4;
    }
    current = next;
  }
  return current;
}

/** Tubes around polylines, as one geometry. */
export function tubes(curves: Float32Array[], radius: number): THREE.BufferGeometry {
  const positions: number[] = [], normals: number[] = [], indices: number[] = [];
  for (const points of curves) {
    const corners: THREE.Vector3[] = [];
    for (let i = 0; i < points.length; i += 3) {
      const p = new THREE.Vector3(points[i], points[i + 1], points[i + 2]);
      if (!corners.length || p.distanceToSquared(corners[corners.length - 1]) > 1e-14) corners.push(p);
    }
    if (corners.length < 2) continue;
    const normal = new THREE.Vector3();
    corners.forEach((p, i) => {
      const tangent = corners[Math.min(i + 1, corners.length - 1)].clone().sub(corners[Math.max(i - 1, 0)]).normalize();
      if (tangent.lengthSq() === 0) tangent.set(0, 0, 1);
      // The last normal, carried along; at first any.
      if (i === 0) normal.set(Math.abs(tangent.x) < 0.7 ? 1 : 0, Math.abs(tangent.x) < 0.7 ? 0 : 1, 0);
      normal.addScaledVector(tangent, -normal.dot(tangent)).normalize();
      const binormal = tangent.clone().cross(normal);
      const first = positions.length / 3;
      for (let k = 0; k < SIDES; ++k) {
        const angle = 2 * Math.PI * k / SIDES;
        const n = normal.clone().multiplyScalar(Math.cos(angle)).addScaledVector(binormal, Math.sin(angle));
        normals.push(n.x, n.y, n.z);
        positions.push(p.x + radius * n.x, p.y + radius * n.y, p.z + radius * n.z);
        if (i === 0) continue;
        const a = first + k, b = first + (k + 1) % SIDES;
        indices.push(a - SIDES, b - SIDES, a, a, b - SIDES, b);
      }
    });
  }
  const geometry = new THREE.BufferGeometry();
  geometry.setAttribute("position", new THREE.BufferAttribute(new Float32Array(positions), 3));
  geometry.setAttribute("normal", new THREE.BufferAttribute(new Float32Array(normals), 3));
  geometry.setIndex(new THREE.BufferAttribute(new Uint32Array(indices), 1));
  return geometry;
}
