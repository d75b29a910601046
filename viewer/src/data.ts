// The scenes as WriteScenePage() writes them, and their arrays as they are drawn.

export interface Kind { name: string; color: string; }
interface Points { points: string; }
export interface SurfaceData extends Points { name: string; isSolid: boolean; isOnlyOnCut: boolean; triangles: string; }
export interface LinesData extends Points { name: string; isCut: boolean; segments: string; }
export interface LabelledData extends Points { kind: number; label: string; }
interface Shares { largest: number; shares: string; }
export interface BoxesData extends Points {
  name: string; valueName: string; areFlat: boolean; rotations: string; spacings: Shares; values: Shares;
}
export interface SceneData {
  title: string;
  origin: number[];
  size: number;
  extent: number[];
  kinds: Kind[];
  surfaces: SurfaceData[];
  lines: LinesData[];
  curves: LabelledData[];
  markers: LabelledData[];
  boxes: BoxesData[];
  figures: [string, string][];
}

function bytesOf(base64: string): ArrayBuffer {
  const text = atob(base64);
  const bytes = new Uint8Array(text.length);
  for (let i = 0; i < text.length; ++i) bytes[i] = text.charCodeAt(i);
  return bytes.buffer;
}

/** offsets + step * integers; the offsets repeat. A loop, as Float32Array.from() takes thirty times as long. */
function scaled(integers: Uint16Array, step: number, offsets: number[]): Float32Array {
  const numbers = new Float32Array(integers.length);
  for (let i = 0, k = 0; i < numbers.length; ++i) {
    numbers[i] = offsets[k] + step * integers[i];
    if (++k === offsets.length) k = 0;
  }
  return numbers;
}

export function indicesOf(base64: string): Uint32Array {
  return new Uint32Array(bytesOf(base64));
}

/** Numbers of Shares(). */
export function numbersOf(shares: Shares): Float32Array {
  return scaled(new Uint16Array(bytesOf(shares.shares)), shares.largest / 65535, [0]);
}

/** Quaternions x, y, z, w. */
export function rotationsOf(base64: string): Float32Array {
  const xyz = new Int16Array(bytesOf(base64));
  const rotations = new Float32Array(xyz.length / 3 * 4);
  for (let i = 0, k = 0; i < xyz.length; i += 3, k += 4) {
    const x = xyz[i] / 32767, y = xyz[i + 1] / 32767, z = xyz[i + 2] / 32767;
    rotations[k] = x;
    rotations[k + 1] = y;
    rotations[k + 2] = z;
    rotations[k + 3] = Math.sqrt(Math.max(0, 1 - x * x - y * y - z * z));
  }
  return rotations;
}

/** The frame of reference of all scenes: the first one's middle is the origin, its largest extent 1. */
export class World {
  constructor(private readonly first: SceneData) {}

  lengthOf(length: number): number { return length / this.first.size; }

  /** Where a scene's cube begins. */
  originOf(scene: SceneData): number[] {
    return scene.origin.map((x, i) => this.lengthOf(x - this.first.origin[i] - this.first.extent[i] / 2));
  }

  positionsOf(scene: SceneData, base64: string): Float32Array {
    return scaled(new Uint16Array(bytesOf(base64)), this.lengthOf(scene.size) / 65535, this.originOf(scene));
  }
}
