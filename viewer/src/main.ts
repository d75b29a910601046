// The page: scenes side by side with one camera and one cut, and the panel that says what is shown.
import * as THREE from "three/build/three.module.js";
import { OrbitControls } from "three/examples/jsm/controls/OrbitControls.js";

import { SCALE, Where } from "./boxes";
import { CutHandle } from "./cut_handle";
import { SceneData, World } from "./data";
import { Pane, SurfaceMode } from "./pane";

type CutName = "X" | "Y" | "Z" | "view" | "off";

function element<T extends HTMLElement>(id: string): T { return document.getElementById(id) as T; }

function add<K extends keyof HTMLElementTagNameMap>(parent: Element, tag: K, text = ""): HTMLElementTagNameMap[K] {
  const child = document.createElement(tag);
  child.textContent = text;
  parent.appendChild(child);
  return child;
}

/** A row of buttons of which one is pressed. */
class Choice<Name extends string> {
  private readonly buttons = new Map<Name, HTMLButtonElement>();

  constructor(id: string, names: { [name in Name]: string }, public value: Name, private readonly changed: () => void) {
    for (const name of Object.keys(names) as Name[]) {
      const button = add(element(id), "button", names[name]);
      button.addEventListener("click", () => this.set(name));
      this.buttons.set(name, button);
    }
    this.press();
  }

  set(name: Name): void {
    this.value = name;
    this.press();
    this.changed();
  }

  next(): void {
    const names = [...this.buttons.keys()];
    this.set(names[(names.indexOf(this.value) + 1) % names.length]);
  }

  private press(): void {
    this.buttons.forEach((button, name) => button.setAttribute("aria-pressed", String(name === this.value)));
  }
}

/** Whether there is no graphics card, so that pixels are dear. */
function isSoftwareRendered(): boolean {
  const gl = document.createElement("canvas").getContext("webgl");
  const names = gl && gl.getExtension("WEBGL_debug_renderer_info");
  return gl !== null && names !== null && /swiftshader|llvmpipe|software/i.test(gl.getParameter(names.UNMASKED_RENDERER_WEBGL));
}

class Viewer {
  private readonly canvas = element<HTMLCanvasElement>("canvas");
  private readonly renderer: THREE.WebGLRenderer;
  private readonly camera = new THREE.PerspectiveCamera(26, 1, 0.01, 100);
  private readonly controls: OrbitControls;
  private readonly panes: Pane[];
  private readonly box = new THREE.Box3();
  private readonly plane = new THREE.Plane();
  private readonly handle = new CutHandle();
  private readonly cut: Choice<CutName>;
  private readonly surface: Choice<SurfaceMode>;
  private readonly frames: Choice<Where>;
  private readonly colour: Choice<"fit" | "axis">;
  private readonly offset = element<HTMLInputElement>("offset");
  private readonly highValue: number;
  private readonly isSolid: boolean;
  private readonly isSoftware: boolean;
  private theme = matchMedia("(prefers-color-scheme: dark)").matches ? "dark" : "light";
  private lastCut = "";
  private isWaiting = false;
  private isMoving = false;
  private rest = 0;
  private mouse: { x: number; y: number } | null = null;
  private dragged: { x: number; y: number; constant: number } | null = null;

  constructor(data: SceneData[]) {
    const world = new World(data[0]);
    this.panes = data.map((scene) => new Pane(world, scene));
    for (const pane of this.panes) this.box.union(pane.box);
    const boxes = this.panes.flatMap((pane) => pane.boxes);
    this.highValue = Math.max(0, ...boxes.map((one) => one.highValue));
    this.isSolid = data.some((scene) => scene.surfaces.some((one) => one.isSolid));

    this.isSoftware = isSoftwareRendered();
    this.renderer = new THREE.WebGLRenderer({ canvas: this.canvas, antialias: !this.isSoftware });
    this.renderer.autoClear = false;
    this.renderer.localClippingEnabled = true;
    this.camera.up.set(0, 0, 1);
    this.controls = new OrbitControls(this.camera, this.canvas);
    this.controls.screenSpacePanning = true;
    this.controls.enableKeys = false;
    this.controls.addEventListener("change", () => this.drawMoving());

    const changed = () => this.change();
    this.cut = new Choice<CutName>("cut", { X: "X", Y: "Y", Z: "Z", view: "View", off: "Off" }, this.isSolid ? "Y" : "off", () => this.turnCut());
    this.surface = new Choice<SurfaceMode>("surface", { solid: "Solid", glass: "Glass", off: "Off" }, "solid", changed);
    this.frames = new Choice<Where>("frames", { cut: "On the cut", everywhere: "Everywhere", off: "Off" }, this.isSolid ? "cut" : "everywhere", changed);
    this.colour = new Choice<"fit" | "axis">("colour", { fit: "By fit", axis: "By axis" }, "fit", changed);
    this.makePanel();
    this.listen();
    this.setTheme(this.theme);
    this.reset();
  }

  /** Where a point of the data is on the screen, for whoever drives the page. */
  screenPosition(pane: number, point: number[]): number[] {
    const { origin, extent, size } = this.panes[0].data;
    const p = new THREE.Vector3(...point.map((x, i) => (x - origin[i] - extent[i] / 2) / size));
    const view = this.viewOf(pane);
    p.project(this.camera);
    return [view.left + (p.x + 1) / 2 * view.width, (1 - p.y) / 2 * view.height];
  }

  private makePanel(): void {
    element("frame-choices").hidden = !this.panes.some((pane) => pane.boxes.length > 0);
    for (const pane of this.panes) add(element("titles"), "div", pane.data.title);
    const shown = new Set(this.panes.flatMap((pane) => pane.names()));
    for (const name of shown) {
      this.addCheck("shown", name, (isShown) => this.panes.forEach((pane) => pane.showName(name, isShown)));
    }
    const kinds = this.panes[0].kinds;
    kinds.forEach((kind, index) => {
      const counts = this.panes.map((pane) => pane.countOfKind[index]);
      if (!counts.some((count) => count > 0)) return;
      const label = this.addCheck("legend", kind.name, (isShown) => this.panes.forEach((pane) => pane.showKind(index, isShown)));
      const swatch = document.createElement("span");
      const isBall = !this.panes.some((pane) => pane.data.curves.some((curve) => curve.kind === index));
      swatch.className = isBall ? "swatch ball" : "swatch";
      swatch.style.background = kind.color;
      label.insertBefore(swatch, label.childNodes[1]);
      add(label, "span", counts.join(" | ")).className = "count";
    });
    if (!element("legend").hasChildNodes()) add(element("legend"), "div", "none").className = "none";

    const names = new Set(this.panes.flatMap((pane) => pane.data.figures.map(([name]) => name)));
    for (const name of names) {
      const row = add(element("figures"), "tr");
      add(row, "td", name);
      for (const pane of this.panes) {
        const figure = pane.data.figures.find(([other]) => other === name);
        add(row, "td", figure ? figure[1] : "");
      }
    }
    element("figures-section").hidden = names.size === 0;
  }

  private addCheck(parent: string, text: string, show: (isShown: boolean) => void): HTMLLabelElement {
    const label = add(element(parent), "label");
    const check = add(label, "input");
    check.type = "checkbox";
    check.checked = true;
    check.addEventListener("change", () => {
      show(check.checked);
      this.change();
    });
    add(label, "span", text);
    return label;
  }

  private showScale(): void {
    const scale = element("scale");
    scale.textContent = "";
    const boxes = this.panes.flatMap((pane) => pane.boxes)[0];
    if (!boxes || this.frames.value === "off") return;
    const bar = add(scale, "div");
    bar.className = "bar";
    const ends = add(scale, "div");
    ends.className = "ends";
    if (this.colour.value === "fit") {
      bar.style.background = `linear-gradient(90deg, ${SCALE.map((color) => color.getStyle()).join(", ")})`;
      add(ends, "span", "0");
      add(ends, "span", boxes.valueName);
      add(ends, "span", "\u2265 " + this.highValue.toPrecision(2));
    } else {
      bar.style.background = "linear-gradient(90deg, #e35757 33%, #4db06b 33% 66%, #4f82ed 66%)";
      for (const axis of ["along x", "y", "z"]) add(ends, "span", axis);
    }
    const count = this.panes.map((pane) => pane.boxes.reduce((sum, one) => sum + one.shown, 0)).join(" | ");
    add(scale, "div", count + " of " + this.panes.map((pane) => pane.boxes.reduce((sum, one) => sum + one.total, 0)).join(" | ") + " frames shown").className = "ends";
  }

  private listen(): void {
    new ResizeObserver(() => this.draw()).observe(this.canvas);
    this.offset.addEventListener("input", () => {
      const [low, high] = this.cutRange();
      this.moveCutTo(-(low + (high - low) * Number(this.offset.value) / 1000));
    });
    element("tools").addEventListener("click", (event) => {
      const key = (event.target as HTMLElement).dataset.key;
      if (key) this.press(key);
    });
    window.addEventListener("keydown", (event) => {
      const isTyping = event.target instanceof HTMLInputElement && event.key.startsWith("Arrow");
      if (event.ctrlKey || event.metaKey || event.altKey || isTyping) return;
      if (this.press(event.key.toLowerCase())) event.preventDefault();
    });
    this.canvas.addEventListener("pointermove", (event) => this.move(event));
    this.canvas.addEventListener("pointerleave", () => this.point(null));
    this.canvas.addEventListener("pointerdown", (event) => this.grab(event), true);
    this.canvas.addEventListener("pointerup", () => { this.dragged = null; });
    this.canvas.addEventListener("webglcontextrestored", () => this.draw());
  }

  /** Whether the key means something. */
  private press(key: string): boolean {
    const cuts: { [key: string]: CutName } = { x: "X", y: "Y", z: "Z", v: "view" };
    if (key in cuts) this.cut.set(cuts[key]);
    else if (key === "c") this.cut.set(this.cut.value === "off" ? "Y" : "off");
    else if (key === "i") { this.plane.negate(); this.change(); }
    else if (key === "arrowleft" || key === "arrowright") this.shiftCut(key === "arrowright" ? 0.01 : -0.01);
    else if (key === "b") this.surface.next();
    else if (key === "g") this.frames.next();
    else if (key === "k") this.colour.next();
    else if (key === "f") this.fit();
    else if (key === "r") this.reset();
    else if (key === "s") this.saveScreenshot();
    else if (key === "t") this.setTheme(this.theme === "dark" ? "light" : "dark");
    else if (key === "p") element("panel").hidden = !element("panel").hidden;
    else if (key === "h" || key === "?") element<HTMLDialogElement>("help").showModal();
    else return false;
    return true;
  }

  /** The cut's least and largest distance from the origin along its normal. */
  private cutRange(): [number, number] {
    const { min, max } = this.box, n = this.plane.normal;
    let low = 0, high = 0;
    for (const i of [0, 1, 2]) {
      const a = n.getComponent(i) * min.getComponent(i), b = n.getComponent(i) * max.getComponent(i);
      low += Math.min(a, b);
      high += Math.max(a, b);
    }
    return [low, high];
  }

  private shiftCut(share: number): void {
    const [low, high] = this.cutRange();
    this.moveCutTo(this.plane.constant - share * (high - low));
  }

  private moveCutTo(constant: number): void {
    const [low, high] = this.cutRange();
    this.plane.constant = Math.min(-low, Math.max(-high, constant));
    this.change();
    this.drawMoving();
  }

  /** Through the middle, and the half away from the viewer is kept. */
  private turnCut(): void {
    const towards = this.camera.position.clone().sub(this.controls.target).normalize();
    const n = this.plane.normal;
    if (this.cut.value === "view") n.copy(towards).negate();
    else if (this.cut.value !== "off") {
      n.set(0, 0, 0).setComponent("XYZ".indexOf(this.cut.value), 1);
      if (n.dot(towards) > 0) n.negate();
    }
    this.plane.constant = -n.dot(this.box.getCenter(new THREE.Vector3()));
    this.change();
  }

  /** Everything in the view, from where one looks. */
  private fit(): void {
    const center = this.box.getCenter(new THREE.Vector3());
    const { width, height } = this.viewOf(0);
    const up = Math.tan(this.camera.fov * Math.PI / 360), right = up * width / height;
    this.camera.updateMatrixWorld(true);
    const [x, y, z] = [0, 1, 2].map((i) => new THREE.Vector3().setFromMatrixColumn(this.camera.matrixWorld, i));
    let distance = 0;
    for (let corner = 0; corner < 8; ++corner) {
      const p = new THREE.Vector3(...[0, 1, 2].map((i) => (corner >> i & 1 ? this.box.max : this.box.min).getComponent(i))).sub(center);
      distance = Math.max(distance, p.dot(z) + Math.max(Math.abs(p.dot(x)) / right, Math.abs(p.dot(y)) / up));
    }
    this.controls.target.copy(center);
    this.camera.position.copy(center).addScaledVector(z, 1.06 * distance);
    this.controls.update();
    this.draw();
  }

  private reset(): void {
    const center = this.box.getCenter(new THREE.Vector3());
    this.controls.target.copy(center);
    this.camera.position.copy(center).add(new THREE.Vector3(0.62, -1.2, 0.62));
    this.camera.lookAt(center);
    this.fit();
    this.cut.set(this.isSolid ? "Y" : "off");
  }

  private setTheme(theme: string): void {
    this.theme = theme;
    document.documentElement.dataset.theme = theme;
    this.change();
  }

  private saveScreenshot(): void {
    this.render();
    this.canvas.toBlob((blob) => {
      const link = document.createElement("a");
      link.href = URL.createObjectURL(blob as Blob);
      link.download = (this.panes[0].data.title.replace(/[^\w.-]+/g, "_").slice(0, 80) || "octupole") + ".png";
      link.click();
      setTimeout(() => URL.revokeObjectURL(link.href), 10000);
    });
  }

  private viewOf(pane: number): { left: number; width: number; height: number } {
    const width = this.canvas.clientWidth / this.panes.length;
    return { left: pane * width, width, height: Math.max(1, this.canvas.clientHeight) };
  }

  private paneAt(x: number): number {
    return Math.min(this.panes.length - 1, Math.floor(x / this.viewOf(0).width));
  }

  private handleDistance(x: number, y: number): number {
    if (!this.handle.object.visible) return Infinity;
    const view = this.viewOf(this.paneAt(x));
    const p = this.handle.object.position.clone().project(this.camera);
    return Math.hypot(view.left + (p.x + 1) / 2 * view.width - x, (1 - p.y) / 2 * view.height - y);
  }

  private grab(event: PointerEvent): void {
    const isHandle = this.handleDistance(event.offsetX, event.offsetY) < 22;
    this.controls.enabled = !isHandle;
    if (!isHandle) return;
    this.canvas.setPointerCapture(event.pointerId);
    this.dragged = { x: event.offsetX, y: event.offsetY, constant: this.plane.constant };
  }

  private move(event: PointerEvent): void {
    if (!this.dragged) {
      this.point(event.buttons ? null : { x: event.offsetX, y: event.offsetY });
      return;
    }
    // By as much as the mouse moves along the normal on the screen; up and down where that is but a point.
    const { width, height } = this.viewOf(0);
    const at = this.handle.object.position;
    const screen = (p: THREE.Vector3) => p.clone().project(this.camera).multiply(new THREE.Vector3(width / 2, -height / 2, 0));
    const pixels = height / (2 * Math.tan(this.camera.fov * Math.PI / 360) * this.camera.position.distanceTo(at));
    const along = screen(at.clone().addScaledVector(this.plane.normal, 0.01)).sub(screen(at)).divideScalar(0.01);
    if (along.length() < 0.3 * pixels) along.set(0, -pixels, 0);
    const way = (along.x * (event.offsetX - this.dragged.x) + along.y * (event.offsetY - this.dragged.y)) / along.lengthSq();
    this.moveCutTo(this.dragged.constant - way);
  }

  private point(mouse: { x: number; y: number } | null): void {
    this.mouse = mouse;
    const isHandle = mouse !== null && this.handleDistance(mouse.x, mouse.y) < 22;
    if (this.handle.lightUp(isHandle)) this.draw();
    this.canvas.style.cursor = isHandle ? "move" : "";
    this.showTip();
  }

  private showTip(): void {
    const tip = element("tip");
    tip.hidden = true;
    if (!this.mouse) return;
    const { x, y } = this.mouse;
    const pane = this.paneAt(x);
    const view = this.viewOf(pane);
    const hit = this.panes[pane].pick(this.camera, view.width, view.height, x - view.left, y, 9);
    if (!hit) return;
    tip.textContent = hit.label;
    tip.hidden = false;
    tip.style.left = Math.min(x + 14, this.canvas.clientWidth - tip.offsetWidth - 8) + "px";
    tip.style.top = Math.min(y + 14, this.canvas.clientHeight - tip.offsetHeight - 8) + "px";
  }

  /** Brings the scenes up to what is chosen. */
  private change(): void {
    const plane = this.cut.value === "off" ? null : this.plane;
    const cut = plane ? [...plane.normal.toArray(), plane.constant].join() : "off";
    for (const pane of this.panes) {
      if (cut !== this.lastCut) pane.cutBy(plane);
      pane.show(plane !== null, this.surface.value, this.theme);
      for (const boxes of pane.boxes) {
        boxes.show(this.frames.value, plane, this.highValue);
        boxes.colorByAxis(this.colour.value === "axis");
      }
    }
    this.lastCut = cut;
    const [low, high] = this.cutRange();
    this.offset.disabled = plane === null;
    this.offset.value = String(1000 * (-this.plane.constant - low) / (high - low || 1));
    this.showScale();
    this.draw();
  }

  /** Soon. Nothing is drawn while nothing changes. */
  private draw(): void {
    if (this.isWaiting) return;
    this.isWaiting = true;
    requestAnimationFrame(() => {
      this.isWaiting = false;
      this.render();
    });
  }

  /** Coarser where pixels are dear, until nothing has moved for a while. */
  private drawMoving(): void {
    if (this.isSoftware) {
      this.isMoving = true;
      clearTimeout(this.rest);
      this.rest = window.setTimeout(() => { this.isMoving = false; this.draw(); }, 250);
    }
    this.draw();
  }

  private render(): void {
    const { clientWidth: width, clientHeight: height } = this.canvas;
    const ratio = this.isMoving ? 0.5 : Math.min(2, devicePixelRatio);
    const size = this.renderer.getSize(new THREE.Vector2());
    if (size.x !== width || size.y !== height || this.renderer.getPixelRatio() !== ratio) {
      this.renderer.setPixelRatio(ratio);
      this.renderer.setSize(width, height, false);
    }
    this.camera.aspect = width / this.panes.length / Math.max(1, height);
    this.camera.updateProjectionMatrix();
    this.camera.updateMatrixWorld(true);
    this.handle.place(this.cut.value === "off" ? null : this.plane, this.box, this.camera, this.theme);
    this.renderer.setClearColor(this.theme === "dark" ? 0x14161b : 0xf6f7f9);
    this.renderer.setScissorTest(true);
    this.panes.forEach((pane, i) => {
      const view = this.viewOf(i);
      this.renderer.setViewport(view.left, 0, view.width, height);
      this.renderer.setScissor(view.left, 0, view.width, height);
      this.renderer.clear();
      this.renderer.render(pane.scene, this.camera);
      this.renderer.render(this.handle.scene, this.camera);
    });
    document.documentElement.dataset.drawn = String(Number(document.documentElement.dataset.drawn || 0) + 1);
  }
}

try {
  const scenes = JSON.parse(element("scenes").textContent as string) as SceneData[];
  Object.assign(window, { viewer: new Viewer(scenes) });
} catch (error) {
  element("message").textContent = "This page needs a browser with WebGL.\n" + (error as Error).message;
  element("message").hidden = false;
  throw error;
}
