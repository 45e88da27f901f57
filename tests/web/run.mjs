#!/usr/bin/env node
// SPDX-License-Identifier: MIT
// Tries the page of samples/web in a headless Chromium: run.mjs PAGE GOFFER MODELS CHECK..
// PAGE is the folder that samples/web/build.sh makes, GOFFER the command that its results are compared with, MODELS
// tests/data. Exit code 0: nothing wrong; 1: a check fails; 77: it cannot be made here.
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { existsSync, mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { createServer } from "node:http";
import { tmpdir } from "node:os";
import { join, resolve } from "node:path";
import { pathToFileURL } from "node:url";
import { Browser, find_chromium } from "./browser.mjs";
import { textured_tube } from "./textured_tube.mjs";

// Pictures are kept and compared in the page.
const helpers = `
  window.pictures = {};
  window.take = (name) => {
    draw();
    const canvas = document.createElement("canvas"), shown = at("canvas");
    canvas.width = shown.width;
    canvas.height = shown.height;
    const context = canvas.getContext("2d", { willReadFrequently: true });
    context.drawImage(shown, 0, 0);
    pictures[name] = context.getImageData(0, 0, canvas.width, canvas.height);
  };
  // Pixels that differ, as a share of all.
  window.difference = (one, other) => {
    const a = pictures[one], b = pictures[other];
    let count = 0;
    for (let i = 0; i < a.data.length; i += 4) {
      const most = Math.max(...[0, 1, 2].map((c) => Math.abs(a.data[i + c] - b.data[i + c])));
      if (most > 8) ++count;
    }
    return count / (a.width * a.height);
  };
  // Pixels that are not gray, as the background is, as a share of all.
  window.colored = (name) => {
    const { data, width, height } = pictures[name];
    let count = 0;
    for (let i = 0; i < data.length; i += 4)
      if (Math.max(data[i], data[i + 1], data[i + 2]) - Math.min(data[i], data[i + 1], data[i + 2]) > 30) ++count;
    return count / (width * height);
  };
  window.set = (id, value) => {
    const input = at(id);
    if (input.type === "checkbox") input.checked = value; else input.value = value;
    input.dispatchEvent(new Event("input", { bubbles: true }));
    input.dispatchEvent(new Event("change", { bubbles: true }));
  };
  // How much a buffer holds depends on the browser: of this one, 256 MiB. It tells, or says that it holds more.
  window.limit_buffers = (device, tells) => {
    const { prototype } = WebGL2RenderingContext, most = 2 ** 28;
    let asked = 0;
    device.bufferData = function (...words) {
      asked = words[4] ?? words[1].byteLength ?? words[1];
      prototype.bufferData.apply(this, asked < most ? words : [words[0], 4, words[2]]);
    };
    device.getBufferParameter = (...words) => tells || asked < most ? prototype.getBufferParameter.apply(device, words) : asked;
  };
  window.idle = () => !document.body.classList.contains("busy");
`;

class Page {
  constructor(browser) { this.browser = browser; }

  static async open(options, folder_url) {
    const browser = new Browser(find_chromium(), options.width ?? 1000, options.height ?? 700, options.touch ?? false);
    const page = new Page(browser);
    try {
      await browser.open(`${folder_url ?? pathToFileURL(options.folder)}/index.html`);
      await browser.until("state !== undefined");
      await browser.value(helpers);
    } catch (error) {
      await browser.close();
      throw new Error(`${error.message}; the console: ${browser.complaints.join("; ")}`);
    }
    return page;
  }

  value(expression) { return this.browser.value(expression); }
  state() { return this.value("state"); }

  /// Sets a control, and waits for what it has done.
  async set(id, value) {
    await this.value(`set(${JSON.stringify(id)}, ${JSON.stringify(value)})`);
    await this.browser.until("idle()");
    assert.equal(await this.value("at('message').classList.contains('failed')"), false, await this.value("at('message').textContent"));
  }

  /// Where a place of the picture is on the page, -1 to 1 from edge to edge.
  async point(x, y) {
    const box = await this.value("(({left, top, width, height}) => ({left, top, width, height}))(at('canvas').getBoundingClientRect())");
    return [box.left + box.width * (x + 1) / 2, box.top + box.height * (1 - y) / 2];
  }

  /// Where the orange end is, on the page.
  async end() {
    const place = await this.value(`(() => {
      let sum = [0, 0, 0];
      for (let y = -1; y <= 1; y += 0.01) for (let x = -1; x <= 1; x += 0.01)
        if (goffer.ccall("goffer_page_end_at", "number", ["number", "number", "number", "number"], [page, x, y, 0.02]) >= 0)
          sum = [sum[0] + x, sum[1] + y, sum[2] + 1];
      return [sum[0] / sum[2], sum[1] / sum[2]];
    })()`);
    return this.point(...place);
  }

  async drop(files) {
    const data = files.map((file) => ({ name: file.split("/").at(-1), bytes: readFileSync(file).toString("base64") }));
    await this.value(`open_files(${JSON.stringify(data)}.map(({ name, bytes }) =>
      new File([Uint8Array.from(atob(bytes), (c) => c.charCodeAt(0))], name)))`);
    await this.browser.until("idle()");
  }

  async close() {
    const { complaints } = this.browser;
    await this.browser.close();
    assert.deepEqual(complaints, [], "the console is not empty");
  }
}

/// With a window in which pictures take less time.
function small(options) { return { ...options, width: 500, height: 350 }; }

async function with_page(options, work) {
  const page = await Page.open(options, options.url);
  let failed = true;
  try {
    await work(page);
    failed = false;
  } finally {
    if (failed) await page.browser.close();
  }
  await page.close();
}

/// The positions that a GLB has of its first primitive.
function positions_of(bytes) {
  const length = bytes.readUInt32LE(12), json = JSON.parse(bytes.subarray(20, 20 + length).toString());
  const binary = bytes.subarray(20 + length + 8);
  const accessor = json.accessors[json.meshes[0].primitives[0].attributes.POSITION], view = json.bufferViews[accessor.bufferView];
  const begin = (view.byteOffset ?? 0) + (accessor.byteOffset ?? 0), stride = view.byteStride ?? 12, positions = [];
  for (let i = 0; i < accessor.count; ++i)
    for (let c = 0; c < 3; ++c) positions.push(binary.readFloatLE(begin + stride * i + 4 * c));
  return positions;
}

const checks = {
  /// It loads from a folder without a word in the console, and shows a body in its colors.
  async load(options) {
    await with_page(options, async (page) => {
      const state = await page.state();
      assert.equal(state.name, "caterpillar.glb");
      assert.ok(state.folds_made > 5 && state.vertices > 5000);
      await page.value("take('first')");
      const share = await page.value("colored('first')");
      assert.ok(share > 0.05 && share < 0.6, `the body has ${share} of the pixels`);
      assert.equal(await page.value("at('message').textContent"), "");
    });
  },

  /// It loads from a server, which says of what type files are, too.
  async server(options) {
    const types = { html: "text/html", js: "text/javascript", css: "text/css" };
    const server = createServer((request, response) => {
      const file = join(options.folder, request.url.slice(1));
      if (!existsSync(file)) return response.writeHead(404).end();
      response.writeHead(200, { "Content-Type": types[file.split(".").at(-1)] }).end(readFileSync(file));
    });
    await new Promise((done) => server.listen(0, "127.0.0.1", done));
    try {
      await with_page({ ...options, url: `http://127.0.0.1:${server.address().port}` }, async (page) => {
        assert.equal((await page.state()).name, "caterpillar.glb");
      });
    } finally {
      server.close();
    }
  },

  /// Sliders bend, and folds come on the inner side: of a bare bend, the outer side looks the same.
  async sliders(options) {
    await with_page(options, async (page) => {
      await page.value("take('right')");
      await page.set("angle", 30);
      assert.equal((await page.state()).regions[0].angle, 30);
      await page.value("take('less')");
      assert.ok(await page.value("difference('right', 'less')") > 0.03);
      await page.set("angle", 90);
      await page.value("take('again')");
      assert.equal(await page.value("difference('right', 'again')"), 0);
      await page.drop([options.worm]);
      await page.set("angle", 120);
      // Seen from the inner side, then from the outer one.
      const turn = (by) => page.value(`tell("orbit", 0, ${by})`);
      await turn(1);
      await page.value("take('folds inside')");
      await turn(-Math.PI);
      await page.value("take('folds outside')");
      await page.set("folds", 0);
      assert.equal((await page.state()).folds_made, 0);
      await page.value("take('none outside')");
      await turn(Math.PI);
      await page.value("take('none inside')");
      const inside = await page.value("difference('folds inside', 'none inside')");
      const outside = await page.value("difference('folds outside', 'none outside')");
      assert.ok(inside > 0.03, `folds change ${inside} of the pixels inside`);
      assert.ok(outside < inside / 3, `folds change ${outside} of the pixels outside, and ${inside} inside`);
    });
  },

  /// The end follows the mouse, and the picture turns where there is no end.
  async drag(options) {
    await with_page(options, async (page) => {
      await page.value("take('before')");
      const [x, y] = await page.end();
      await page.browser.mouse("mousePressed", x, y);
      for (let i = 1; i <= 10; ++i) await page.browser.mouse("mouseMoved", x + 6 * i, y + 8 * i);
      await page.browser.mouse("mouseReleased", x + 60, y + 80);
      await page.value("take('dragged')");
      const [to_x, to_y] = await page.end();
      assert.ok(Math.hypot(to_x - x, to_y - y) > 30, "the end has not followed");
      assert.ok(Math.abs((await page.state()).regions[0].angle - 90) > 5);
      const corner = await page.point(-0.9, -0.9);
      await page.browser.mouse("mousePressed", ...corner);
      await page.browser.mouse("mouseMoved", corner[0] + 100, corner[1] - 20);
      await page.browser.mouse("mouseReleased", corner[0] + 100, corner[1] - 20);
      await page.value("take('turned')");
      assert.ok(await page.value("difference('dragged', 'turned')") > 0.02);
    });
  },

  /// A crowd of 200 is drawn, moves, and is the same from the shader.
  async crowd(options) {
    await with_page(small(options), async (page) => {
      await page.drop([options.hose]);
      await page.set("instances", 200);
      assert.equal((await page.state()).instances, 200);
      assert.equal(await page.value("at('animated').checked"), true);
      await page.value("take('one')");
      assert.ok(await page.value("colored('one')") > 0.05);
      await page.value("new Promise((done) => setTimeout(done, 500))");
      await page.value("take('later')");
      assert.ok(await page.value("difference('one', 'later')") > 0.01, "the crowd stands still");
      await page.set("animated", false);
      await page.value("take('processor')");
      await page.set("shader", true);
      await page.value("take('shader')");
      const difference = await page.value("difference('processor', 'shader')");
      assert.ok(difference < 1e-3, `the shader's picture differs in ${difference} of the pixels`);
    });
  },

  /// Files are opened; what is no model is refused in words, and what was there stays.
  async open(options) {
    await with_page(options, async (page) => {
      await page.drop([join(options.models, "fuze.ply")]);
      assert.equal((await page.state()).name, "fuze.ply");
      await page.value("take('fuze')");
      await page.value("state = ask('look')");
      await page.set("angle", 45);
      await page.value("take('less')");
      assert.ok(await page.value("difference('fuze', 'less')") > 0.02);
      const broken = join(options.work, "broken.glb");
      writeFileSync(broken, "glTF\u0002 and no more");
      await page.drop([broken]);
      assert.equal(await page.value("at('message').classList.contains('failed')"), true);
      assert.match(await page.value("at('message').textContent"), /broken\.glb/);
      assert.equal((await page.state()).name, "fuze.ply");
      await page.drop([join(options.models, "wine_bottle.glb")]);
      assert.equal((await page.state()).name, "wine_bottle.glb");
      await page.set("regions", 3);
      assert.equal((await page.state()).regions.length, 3);
      for (const [id, value] of [["profile", "damped"], ["amplitude", "paper"], ["shape", "cylinder"], ["onset", 0.1]])
        await page.set(id, value);
      const state = await page.state();
      assert.deepEqual([state.profile, state.amplitude, state.shape], ["damped", "paper", "cylinder"]);
    });
  },

  /// A crowd that memory does not hold is refused in words, and what was there stays; so with one that memory holds
  /// and a buffer of the device does not, and with a lost context.
  async limits(options) {
    const large = join(options.work, "large.glb");
    execFileSync(options.goffer, ["base", "--length", "20", "--radius", "1", "--columns", "200", "--rows", "500", "--caps", "-o", large]);
    await with_page(small(options), async (page) => {
      await page.drop([options.hose]);
      await page.value("attempt(() => { state = ask('crowd', ['number'], [2000]); })");
      await page.drop([large]);
      assert.match(await page.value("at('message').textContent"), /GB of memory/);
      assert.equal((await page.state()).name, "hose.glb");
      await page.set("profile", "damped");  // from the file that was there
      await page.set("instances", 0);
      await page.drop([large]);
      assert.equal((await page.state()).name, "large.glb");
      await page.value("attempt(() => { state = ask('crowd', ['number'], [2000]); })");
      assert.match(await page.value("at('message').textContent"), /GB of memory/);
      assert.equal((await page.state()).instances, 0);
      const medium = join(options.work, "medium.glb");
      execFileSync(options.goffer, ["base", "--columns", "150", "--rows", "1000", "-o", medium]);
      await page.drop([medium]);
      for (const says_so of [true, false]) {
        await page.value(`limit_buffers(at("canvas").getContext("webgl2"), ${says_so})`);
        await page.value("attempt(() => { state = ask('crowd', ['number'], [200]); })");
        await page.browser.until("at('message').textContent");  // from the next frame
        assert.match(await page.value("at('message').textContent"), /more than a buffer of this device holds/);
        assert.equal((await page.state()).instances, 0);
      }
      await page.value("take('one')");
      assert.deepEqual(await page.value("goffer.FS.readdir('/').filter((name) => name.startsWith('opened'))"), ["opened3"]);
      await page.value("at('canvas').getContext('webgl2').getExtension('WEBGL_lose_context').loseContext()");
      await page.browser.until("at('panel').inert");
      assert.match(await page.value("at('message').textContent"), /load the page again/);
      await page.value("set('angle', 10)");
      const { complaints } = page.browser;  // Chromium has its own words for the buffer
      complaints.splice(0, complaints.length, ...complaints.filter((text) => !text.includes("bufferSubData")));
    });
  },

  /// A texture shows, each half of it on its half of the body, from both deformers.
  async texture(options) {
    const file = join(options.work, "tube.glb");
    writeFileSync(file, textured_tube());
    await with_page(options, async (page) => {
      await page.drop([file]);
      await page.set("angle", 0);
      // How much of what is colored is red, left and right of the middle of the colored part.
      const red = () => page.value(`(() => {
        take("texture");
        const { data, width } = pictures.texture, places = [[], []];
        for (let i = 0; i < data.length; i += 4) {
          if (Math.abs(data[i] - data[i + 2]) > 60) places[data[i] > data[i + 2] ? 0 : 1].push(i / 4 % width);
        }
        const mean = (list) => list.reduce((sum, x) => sum + x, 0) / list.length;
        return { red: places[0].length, blue: places[1].length, apart: Math.abs(mean(places[0]) - mean(places[1])) / width };
      })()`);
      const processor = await red();
      assert.ok(Math.min(processor.red, processor.blue) > 5000, JSON.stringify(processor));
      assert.ok(processor.apart > 0.1, JSON.stringify(processor));
      await page.set("shader", true);
      const shader = await red();
      assert.ok(Math.abs(shader.red - processor.red) < 0.02 * processor.red, JSON.stringify([processor, shader]));
      await page.set("area", true);
      assert.ok((await red()).blue < 0.1 * processor.blue, "the colors of areas do not replace it");
    });
  },

  /// The model that it saves is what the command makes.
  async save(options) {
    await with_page(options, async (page) => {
      await page.drop([options.worm]);
      await page.set("angle", 75);
      await page.set("direction", 40);
      const saved = await page.value(`(() => {
        const { file } = ask("save");
        return btoa(Array.from(goffer.FS.readFile(file), (byte) => String.fromCharCode(byte)).join(""));
      })()`);
      const command = (await page.value("ask('command').command")).split(" ");
      assert.deepEqual(command.slice(0, 3), ["goffer", "bend", "worm.glb"]);
      const bent = join(options.work, "bent.glb");
      execFileSync(options.goffer, ["bend", options.worm, ...command.slice(3, command.indexOf("-o")), "-o", bent]);
      const here = positions_of(readFileSync(bent)), there = positions_of(Buffer.from(saved, "base64"));
      assert.equal(here.length, there.length);
      const worst = Math.max(...here.map((value, i) => Math.abs(value - there[i])));
      assert.ok(worst < 20 * 5e-6, `positions differ by ${worst} of a length of 20`);
    });
  },

  /// Nothing is wider than a phone, the panel scrolls, and fingers bend and zoom.
  async phone(options) {
    await with_page({ ...options, width: 360, height: 740, touch: true }, async (page) => {
      const [inner, wide] = await page.value("[window.innerWidth, document.documentElement.scrollWidth]");
      assert.equal(inner, 360);
      assert.ok(wide <= 360, `the page is ${wide} wide`);
      for (const id of ["angle", "fold_length", "save", "name"]) {
        const [left, right] = await page.value(`(({left, right}) => [left, right])(at("${id}").getBoundingClientRect())`);
        assert.ok(left >= 0 && right <= 360, `${id} reaches from ${left} to ${right}`);
      }
      assert.ok(await page.value("at('panel').scrollHeight > at('panel').clientHeight"));
      await page.value("take('before')");
      const touch = (type, points) => page.browser.send("Input.dispatchTouchEvent", { type, touchPoints: points });
      const [x, y] = await page.end();
      await touch("touchStart", [{ x, y }]);
      for (let i = 1; i <= 5; ++i) await touch("touchMove", [{ x: x + 8 * i, y: y + 10 * i }]);
      await touch("touchEnd", []);
      assert.ok(Math.abs((await page.state()).regions[0].angle - 90) > 3, "the finger has not bent it");
      await page.value("take('bent')");
      const [middle_x, middle_y] = await page.point(0, 0);
      const fingers = (apart) => [{ x: middle_x - apart, y: middle_y - 60 }, { x: middle_x + apart, y: middle_y + 60 }];
      await touch("touchStart", fingers(20));
      for (let i = 1; i <= 5; ++i) await touch("touchMove", fingers(20 + 20 * i));
      await touch("touchEnd", []);
      await page.value("take('near')");
      assert.ok(await page.value("colored('near')") > 1.3 * await page.value("colored('bent')"), "two fingers have not zoomed");
    });
  },
};

const [folder, goffer, models, ...wanted] = process.argv.slice(2);
for (const [is_here, what] of [[existsSync(join(folder, "goffer.js")), `no page in ${folder}: bash samples/web/build.sh makes it`],
                               [find_chromium(), "no chromium"]]) {
  if (!is_here) {
    console.log(`skipped: ${what}`);
    process.exit(77);
  }
}
const work = mkdtempSync(join(tmpdir(), "goffer-web-"));
const options = { folder: resolve(folder), goffer: resolve(goffer), models: resolve(models), work };
// The hose is for crowds: few vertices, since they are drawn in software.
for (const [name, length, columns, rows] of [["worm", 20, 32, 161], ["hose", 6, 12, 13]]) {
  options[name] = join(work, `${name}.glb`);
  execFileSync(options.goffer, ["base", "--length", length, "--radius", "1", "--columns", columns, "--rows", rows, "--caps",
    "-o", options[name]].map(String));
}
let failed = 0;
for (const name of wanted) {
  try {
    await checks[name](options);
    console.log(`${name}: ok`);
  } catch (error) {
    ++failed;
    console.log(`${name}: ${error.stack}`);
  }
}
rmSync(work, { recursive: true, force: true });
process.exit(failed > 0 ? 1 : 0);
