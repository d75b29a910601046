// Pages as users get them, in a real browser without a graphics card.
// OCTUPOLE names the command; CHROMIUM the browser, if it is not /usr/bin/chromium.
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { existsSync, mkdtempSync, rmSync, statSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join, resolve } from "node:path";
import { after, before, test } from "node:test";
import { pathToFileURL } from "node:url";
import { chromium } from "playwright-core";

const command = resolve(process.env.OCTUPOLE ?? "../build/dev/tools/octupole");
const bracket = resolve("../examples/data/bracket.mesh");
const folder = mkdtempSync(join(tmpdir(), "octupole_page_"));
let browser;

before(async () => {
  browser = await chromium.launch({
    executablePath: process.env.CHROMIUM ?? "/usr/bin/chromium",
    args: ["--no-sandbox", "--disable-gpu", "--disable-quic", "--no-first-run", "--disable-background-networking",
           "--disable-component-update", "--disable-sync", "--use-angle=swiftshader", "--enable-unsafe-swiftshader"],
  });
});
after(async () => {
  await browser?.close();
  rmSync(folder, { recursive: true });
});

function octupole(...args) {
  execFileSync(command, args, { cwd: folder, stdio: ["ignore", "ignore", "inherit"] });
}

/** A cube of n^3 cells, six tets in each, in two regions; the cells' own axes are its field, without singularities. */
function writeCube(name, n) {
  const at = (x, y, z) => 1 + x + (n + 1) * (y + (n + 1) * z);
  const range = [...Array(n + 1).keys()], cells = range.slice(0, n);
  const points = range.flatMap((z) => range.flatMap((y) => range.map((x) => `${x} ${y} ${z} 0`)));
  const orders = [[0, 1, 2], [0, 2, 1], [1, 0, 2], [1, 2, 0], [2, 0, 1], [2, 1, 0]];
  const tets = cells.flatMap((z) => cells.flatMap((y) => cells.flatMap((x) => orders.map((order) => {
    const corner = [x, y, z];
    const vertices = [at(...corner), ...order.map((axis) => { ++corner[axis]; return at(...corner); })];
    return `${vertices.join(" ")} ${2 * x < n ? 1 : 2}`;
  }))));
  writeFileSync(join(folder, name), ["MeshVersionFormatted 2", "Dimension 3", "Vertices", points.length, ...points,
                                     "Tetrahedra", tets.length, ...tets, "End", ""].join("\n"));
}

/** Opens a page, gives it to `use` once it has been drawn, and wants no errors. */
async function open(name, use, options = {}) {
  const context = await browser.newContext({ viewport: { width: 1366, height: 768 }, ...options });
  const page = await context.newPage();
  const errors = [];
  page.on("console", (message) => message.type() === "error" && errors.push(message.text()));
  page.on("pageerror", (error) => errors.push(error.stack));
  page.on("dialog", (dialog) => { errors.push("a dialog: " + dialog.message()); dialog.dismiss(); });
  page.on("request", (request) => /^(file|data|blob):/.test(request.url()) || errors.push("a request: " + request.url()));
  await page.goto(pathToFileURL(join(folder, name)).href);
  try {
    await drawn(page, 0);
    await use(page);
  } finally {
    await context.close();
  }
  assert.deepEqual(errors, []);
}

const draws = (page) => page.evaluate(() => Number(document.documentElement.dataset.drawn || 0));

/** Waits until the page has been drawn more than `times` times. */
async function drawn(page, times) {
  for (let i = 0; i < 600; ++i) {
    if (await draws(page) > times) return;
    await page.waitForTimeout(50);
  }
  assert.fail("nothing is drawn");
}

/** The colours of a grid of pixels of the picture as it is now. */
function colours(page) {
  return page.evaluate(() => {
    const viewer = window.viewer, gl = viewer.renderer.getContext();
    viewer.render();
    const width = gl.drawingBufferWidth, height = gl.drawingBufferHeight, pixels = new Uint8Array(4 * width * height);
    gl.readPixels(0, 0, width, height, gl.RGBA, gl.UNSIGNED_BYTE, pixels);
    const found = [];
    for (let y = 2; y < height; y += 4) for (let x = 2; x < width; x += 4) {
      const i = 4 * (x + width * y);
      found.push(pixels[i] << 16 | pixels[i + 1] << 8 | pixels[i + 2]);
    }
    return found;
  });
}

const shareThatDiffers = (a, b) => a.filter((colour, i) => colour !== b[i]).length / a.length;
const background = (picture) => picture[0];
const shareDrawn = (picture) => picture.filter((colour) => colour !== background(picture)).length / picture.length;

async function press(page, key) {
  const times = await draws(page);
  await page.keyboard.press(key);
  await drawn(page, times);
}

/** Points the mouse at the middle of the longest curve that is chosen, in a pane, and gives what the page says. */
async function hover(page, pane, label) {
  const [x, y] = await page.evaluate(([at, wanted]) => {
    const scene = JSON.parse(document.getElementById("scenes").textContent)[at];
    const ofLabel = scene.curves.filter((curve) => curve.label.includes(wanted));
    const { points } = ofLabel.sort((a, b) => b.points.length - a.points.length)[0];
    const shares = new Uint16Array(Uint8Array.from(atob(points), (c) => c.charCodeAt(0)).buffer);
    const middle = 3 * Math.floor(shares.length / 6);
    return window.viewer.screenPosition(at, [0, 1, 2].map((i) => scene.origin[i] + shares[middle + i] / 65535 * scene.size));
  }, [pane, label]);
  await page.mouse.move(x, y);
  const tip = page.locator("#tip");
  return await tip.isVisible() ? tip.innerText() : "";
}

test("a field with singular curves", async () => {
  octupole("field", bracket, "-o", "bracket.vtu", "--singularities", "curves.vtu", "--html", "bracket.html", "--quiet");
  await open("bracket.html", async (page) => {
    assert.equal(await page.title(), "bracket.mesh");
    const first = await colours(page);
    assert.ok(shareDrawn(first) > 0.1, `drawn is ${shareDrawn(first)} of the picture`);
    assert.ok(new Set(first).size > 50, "hardly any colours");

    const tip = await hover(page, 0, "valence 5");
    assert.match(tip, /^valence 5\nquarter turn, index -1\/4\nlength \d/);
    assert.match(await page.locator("#legend").innerText(), /valence 3[^]*valence 5[^]*node/);
    assert.match(await page.locator("#figures").innerText(), /vertices\s+5291\s/);
    await page.mouse.move(3, 300);
    assert.ok(await page.locator("#tip").isHidden());

    await press(page, "z");
    const cut = await colours(page);
    assert.ok(shareThatDiffers(first, cut) > 0.02, "another cut, the same picture");
    await press(page, "c");
    assert.ok(shareThatDiffers(cut, await colours(page)) > 0.02, "no cut, the same picture");
    await press(page, "r");
    assert.ok(shareThatDiffers(first, await colours(page)) < 0.001, "reset, another picture");
  });
});

test("the cut is dragged, shifted and turned over", async () => {
  await open("bracket.html", async (page) => {
    const offset = () => page.locator("#offset").inputValue().then(Number);
    const [x, y] = await page.evaluate(() => {
      const viewer = window.viewer, p = viewer.handle.object.position.clone().project(viewer.camera);
      const { clientWidth, clientHeight } = viewer.canvas;
      return [(p.x + 1) / 2 * clientWidth, (1 - p.y) / 2 * clientHeight];
    });
    const eye = () => page.evaluate(() => window.viewer.camera.position.toArray().map((c) => c.toFixed(6)).join());
    const before = await offset(), from = await eye();
    await page.mouse.move(x, y);
    await page.mouse.down();
    await page.mouse.move(x + 40, y - 60, { steps: 3 });
    await page.mouse.up();
    assert.ok(Math.abs(await offset() - before) > 50, "dragged, but not moved");
    assert.equal(await eye(), from, "dragging the cut turns the view");
    await page.mouse.move(300, 300);
    await page.mouse.down();
    await page.mouse.move(340, 320, { steps: 3 });
    await page.mouse.up();
    assert.notEqual(await eye(), from, "dragging does not turn the view");

    const shifted = await offset();
    await press(page, "ArrowRight");
    assert.ok(Math.abs(await offset() - shifted) > 5);
    const picture = await colours(page);
    await press(page, "i");
    assert.ok(shareThatDiffers(picture, await colours(page)) > 0.02);
  });
});

test("choices, theme and screenshot", async () => {
  await open("bracket.html", async (page) => {
    const pressed = (id) => page.locator(`#${id} [aria-pressed=true]`).innerText();
    let picture = await colours(page);
    for (const [key, id, next] of [["b", "surface", "Glass"], ["g", "frames", "Everywhere"], ["k", "colour", "By axis"]]) {
      await press(page, key);
      assert.equal(await pressed(id), next);
      const changed = await colours(page);
      assert.ok(shareThatDiffers(picture, changed) > 0.005, `${next}: the same picture`);
      picture = changed;
    }
    const light = background(picture);
    await press(page, "t");
    assert.notEqual(background(await colours(page)), light);
    const [download] = await Promise.all([page.waitForEvent("download"), page.keyboard.press("s")]);
    assert.equal(download.suggestedFilename(), "bracket.mesh.png");
    await page.keyboard.press("h");
    assert.ok(await page.locator("#help").isVisible());
  });
});

test("dark, where that is preferred", async () => {
  await open("bracket.html", async (page) => {
    assert.ok((background(await colours(page)) & 0xff) < 0x40);
  }, { colorScheme: "dark" });
});

test("two fields side by side", async () => {
  octupole("view", "bracket.vtu", "--singularities", "curves.vtu", "--with", "bracket.vtu", "-o", "two.html");
  await open("two.html", async (page) => {
    assert.deepEqual(await page.locator("#titles div").allInnerTexts(), ["bracket.vtu", "bracket.vtu"]);
    assert.match(await hover(page, 0, "valence 3"), /^valence 3\n.*index 1\/4/);
    assert.match(await hover(page, 1, "valence 3"), /^valence 3\n.*index 1\/4/);
    assert.equal(await page.locator("#figures tr:first-child td").count(), 3);
  });
});

test("no singular curves, two regions, and a name that means mischief", async () => {
  const name = "a\"'&lt;<script>alert(1)<!--<img src=x onerror=alert(2)>.mesh";
  writeCube(name, 6);
  octupole("field", name, "-o", "cube.vtu", "--html", "cube.html", "--quiet");
  await open("cube.html", async (page) => {
    assert.equal(await page.title(), name);
    assert.equal(await page.locator("#titles").innerText(), name);
    assert.match(await page.locator("#legend").innerText(), /^valence 3, index 1\/4\s+8$/);  // the corners
    const picture = await colours(page);
    assert.ok(shareDrawn(picture) > 0.1);
    await page.getByText("interfaces").click();
    assert.ok(shareThatDiffers(picture, await colours(page)) > 0.001, "the interface is not seen");
  });
});

test("a cross field on a surface", async () => {
  writeFileSync(join(folder, "cube.obj"), ["v 0 0 0", "v 1 0 0", "v 1 1 0", "v 0 1 0", "v 0 0 1", "v 1 0 1", "v 1 1 1",
    "v 0 1 1", "f 4 3 2 1", "f 5 6 7 8", "f 1 2 6 5", "f 2 3 7 6", "f 3 4 8 7", "f 4 1 5 8", ""].join("\n"));
  octupole("surface", "cube.obj", "-o", "surface.vtu", "--html", "surface.html", "--quiet");
  octupole("view", "surface.vtu", "-o", "surface_view.html");
  for (const file of ["surface.html", "surface_view.html"]) {
    await open(file, async (page) => {
      assert.ok(shareDrawn(await colours(page)) > 0.1);
      assert.match(await page.locator("#scale").innerText(), /8 of 8 frames shown/);
    });
  }
});

test("no singularities at all", async () => {
  writeFileSync(join(folder, "plate.obj"), ["v 0 0 0", "v 1 0 0", "v 1 1 0", "v 0 1 0", "f 1 2 3 4", ""].join("\n"));
  octupole("surface", "plate.obj", "-o", "plate.vtu", "--html", "plate.html", "--quiet");
  await open("plate.html", async (page) => {
    assert.equal(await page.locator("#legend").innerText(), "none");
    assert.ok(shareDrawn(await colours(page)) > 0.1);
  });
});

const large = join(process.env.OCTUPOLE_CORPUS ?? "", "tet/mambo_m6_230k.mesh");
test("230,000 vertices", { skip: existsSync(large) ? false : "OCTUPOLE_CORPUS is not set" }, async (context) => {
  octupole("field", large, "-o", "large.vtu", "--html", "large.html", "--quiet");
  const size = statSync(join(folder, "large.html")).size / 1e6;
  const start = Date.now();
  await open("large.html", async (page) => {
    context.diagnostic(`${size.toFixed(1)} MB, drawn after ${Date.now() - start} ms`);
    assert.ok(shareDrawn(await colours(page)) > 0.1);
  });
  assert.ok(size < 15, `${size} MB`);
});
