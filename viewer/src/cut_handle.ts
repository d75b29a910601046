import * as THREE from "three/build/three.module.js";

/** The outline of the cut with the arrow by which one drags it, over everything else. */
export class CutHandle {
  readonly scene = new THREE.Scene();
  /** Its position is where one grabs. */
  readonly object = new THREE.Group();
  private readonly outline: THREE.LineLoop;
  private readonly line = new THREE.LineBasicMaterial({ transparent: true, opacity: 0.55, depthTest: false });
  private readonly paint = new THREE.MeshBasicMaterial({ depthTest: false });
  private isLit = false;

  constructor() {
    const geometry = new THREE.BufferGeometry();
    geometry.setAttribute("position", new THREE.BufferAttribute(new Float32Array(12), 3));
    this.outline = new THREE.LineLoop(geometry, this.line);
    this.outline.frustumCulled = false;
    const shaft = new THREE.Mesh(new THREE.CylinderBufferGeometry(0.05, 0.05, 2, 12), this.paint);
    for (const side of [1, -1]) {
      const tip = new THREE.Mesh(new THREE.ConeBufferGeometry(0.2, 0.55, 16), this.paint);
      tip.position.y = 1.1 * side;
      if (side < 0) tip.rotation.x = Math.PI;
      this.object.add(tip);
    }
    this.object.add(shaft, new THREE.Mesh(new THREE.SphereBufferGeometry(0.17, 16, 12), this.paint));
    this.scene.add(this.outline, this.object);
  }

  /** Whether that changes anything. */
  lightUp(isLit: boolean): boolean {
    const changes = this.isLit !== isLit;
    this.isLit = isLit;
    return changes;
  }

  /** Around the box; the arrow is at the corner that is farthest to the right, 36 pixels or so long. */
  place(plane: THREE.Plane | null, box: THREE.Box3, camera: THREE.PerspectiveCamera, theme: string): void {
    this.object.visible = this.outline.visible = plane !== null;
    if (!plane) return;
    const color = this.isLit ? 0xf59e0b : theme === "dark" ? 0x7aa7ff : 0x2f6fde;
    this.line.color.set(color);
    this.paint.color.set(color);

    const center = plane.projectPoint(box.getCenter(new THREE.Vector3()), new THREE.Vector3());
    const up = new THREE.Vector3(0, 0, 1);
    if (Math.abs(plane.normal.z) > 0.99) up.set(0, 1, 0);
    const right = up.clone().cross(plane.normal).normalize();
    up.copy(plane.normal).cross(right).normalize();
    const size = box.getSize(new THREE.Vector3());
    const reach = (d: THREE.Vector3) => 0.54 * (Math.abs(d.x) * size.x + Math.abs(d.y) * size.y + Math.abs(d.z) * size.z);
    const corners = [[1, 1], [-1, 1], [-1, -1], [1, -1]].map(([a, b]) =>
      center.clone().addScaledVector(right, a * reach(right)).addScaledVector(up, b * reach(up)));
    const positions = this.outline.geometry as THREE.BufferGeometry;
    corners.forEach((corner, i) => (positions.attributes.position as THREE.BufferAttribute).setXYZ(i, corner.x, corner.y, corner.z));
    (positions.attributes.position as THREE.BufferAttribute).needsUpdate = true;

    const onScreen = corners.map((corner) => corner.clone().project(camera));
    const best = onScreen.reduce((a, p, i) => (p.x - 0.3 * p.y > onScreen[a].x - 0.3 * onScreen[a].y ? i : a), 0);
    this.object.position.copy(corners[best]);
    this.object.quaternion.setFromUnitVectors(new THREE.Vector3(0, 1, 0), plane.normal);
    this.object.scale.setScalar(0.024 * camera.position.distanceTo(corners[best]));
  }
}
