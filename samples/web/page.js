// SPDX-License-Identifier: MIT
// The controls of the page. What is drawn, and how, is in page.hpp.
"use strict";

const at = (id) => document.getElementById(id);
const all = (selector) => [...document.querySelectorAll(selector)];
const frames_per_second = 60;
const models = /\.(glb|gltf|obj|ply|stl|goffer)$/i;

let goffer, page, state;
const started = performance.now();
let region = 0, dirty = true, waiting = 0, folders = 0, failed = false, opened;  // opened: the folder that the models on stage lie in

/// After what there is no way back from.
function give_up(text) {
  page = undefined;
  at("panel").inert = true;
  say(text, true);
}

/// Calls a function of exports.cpp that returns text; throws what it says is wrong.
function ask(name, types = [], values = []) {
  if (!page) throw new Error("load the page again");
  const answer = JSON.parse(goffer.ccall("goffer_page_" + name, "string", ["number", ...types], [page, ...values]));
  dirty = true;
  if (answer.error) throw new Error(answer.error);
  return answer;
}

function tell(name, ...values) {
  if (!page) return;
  goffer.ccall("goffer_page_" + name, null, ["number", ...values.map(() => "number")], [page, ...values]);
  dirty = true;
}

function say(text, failed = false) {
  at("message").textContent = text.replaceAll(/\/opened\d+\//g, "");  // where dropped files are kept
  at("message").classList.toggle("failed", failed);
}

/// Does what may fail; says so where it does, and has the controls show what is.
function attempt(work) {
  if (!page) return;
  try {
    say("");
    work();
  } catch (error) {
    if (error instanceof WebAssembly.RuntimeError) return give_up(`goffer has failed (${error.message}): load the page again.`);
    say(error.message, true);
    state = ask("state");
  }
  show_state();
}

/// The same for what takes long: the page says so first.
function attempt_later(text, work) {
  ++waiting;
  document.body.classList.add("busy");
  say(text);
  requestAnimationFrame(() => setTimeout(() => {
    attempt(work);
    if (--waiting === 0) document.body.classList.remove("busy");
  }));
}

const degrees = (value) => `${Math.round(10 * value) / 10}°`;

const is_automatic = (input) => input.dataset.auto !== undefined && Number(input.value) <= Number(input.dataset.auto);

/// What a control that binds is set to, as exports.cpp takes it.
function value_of(input) {
  if (input.type !== "range") return input.value;
  return Number(is_automatic(input) ? input.dataset.autoValue : input.value);
}

function show_automatic(input) {
  document.querySelector(`output[for=${input.id}]`).textContent = is_automatic(input) ? "auto" : input.value;
}

function show_state() {
  region = Math.min(region, state.regions.length - 1);
  const now = state.regions[region], limit = Math.floor(2 * now.limit) / 2;
  document.title = `goffer: ${state.name}`;
  at("name").textContent = state.name + (state.models > 1 ? ` and ${state.models - 1} more` : "");
  at("about").textContent = `${state.vertices.toLocaleString("en")} vertices, ${state.folds_made} folds`;
  at("warnings").replaceChildren(...state.warnings.map((text) => {
    const line = document.createElement("li");
    line.textContent = text;
    return line;
  }));
  at("angle").min = -limit;
  at("angle").max = limit;
  at("angle").value = now.angle;
  at("direction").value = now.direction;
  document.querySelector("output[for=angle]").textContent = degrees(now.angle);
  document.querySelector("output[for=direction]").textContent = degrees(now.direction);
  at("regions").value = state.regions.length;
  for (const id of ["profile", "amplitude", "shape", "onset"]) at(id).value = state[id];
  at("folds").value = state.folds;
  at("fold_length").value = state.fold_length > 0 ? state.fold_length : at("fold_length").min;
  at("instances").value = state.instances;
  at("shader").checked = state.shader;
  all("input[data-bind]").forEach(show_automatic);
  document.querySelector("output[for=instances]").textContent = state.instances || "one body";
  at("area_hint").hidden = !at("area").checked;
  at("wrinkles").hidden = state.baked;
  at("regions").disabled = state.baked;
  for (const input of all("input[data-one]")) input.disabled = state.instances > 0;
  at("base").disabled ||= state.baked;  // a body file does not say what its body was bound to
  show_tabs();
}

/// Has the sliders be about a region.
function choose(index) {
  region = index;
  const { angle, direction } = state.regions[index];
  attempt(() => { state = ask("bend", ["number", "number", "number"], [index, angle, direction]); });
}

function show_tabs() {
  at("tabs").hidden = state.regions.length < 2;
  at("tabs").replaceChildren(...state.regions.map((_, index) => {
    const button = document.createElement("button");
    button.textContent = index + 1;
    button.title = `Region ${index + 1}, counted from the base`;
    button.setAttribute("aria-pressed", index === region);
    button.onclick = () => choose(index);
    return button;
  }));
}

// The panel.

function listen_to_panel() {
  for (const id of ["angle", "direction"]) {
    at(id).oninput = () => attempt(() => {
      const values = [region, Number(at("angle").value), Number(at("direction").value)];
      state = ask("bend", ["number", "number", "number"], values);
    });
  }
  for (const input of all("[data-bind]")) {
    input.oninput = () => { if (input.type === "range") show_automatic(input); };
    input.onchange = () => {
      const words = JSON.stringify({ [input.id]: value_of(input) });
      attempt_later("Binding ..", () => { state = ask("bind", ["string"], [words]); });
    };
  }
  for (const input of all("[data-show]")) {
    input.onchange = () => attempt(() => {
      state = ask("show", ["string"], [JSON.stringify({ [input.id]: input.checked })]);
    });
  }
  at("instances").oninput = () => attempt(() => {
    const crowd = Number(at("instances").value);
    if (crowd > 0 && state.instances === 0) at("animated").checked = true;
    state = ask("crowd", ["number"], [crowd]);
  });
  at("animated").onchange = () => { dirty = true; };
  at("look").onclick = () => attempt(() => { state = ask("look"); });
  at("open").onclick = () => at("files").click();
  at("files").onchange = () => { open_files([...at("files").files]); at("files").value = ""; };
  at("save").onclick = () => attempt(() => {
    const { file } = ask("save");
    download(new Blob([goffer.FS.readFile(file)], { type: "model/gltf-binary" }), file.slice(1));
    goffer.FS.unlink(file);
  });
  at("shot").onclick = () => attempt(() => {
    draw();  // what is on the canvas is gone once this function has ended
    const name = state.name.replace(models, "") + "-bent.png";
    at("canvas").toBlob((blob) => download(blob, name), "image/png");
  });
  at("copy").onclick = () => attempt(() => {
    const { command } = ask("command");
    if (!navigator.clipboard) return say(command);  // as on pages without https
    navigator.clipboard.writeText(command).then(() => say("The command is in the clipboard."), () => say(command));
  });
}

function download(blob, name) {
  const link = document.createElement("a");
  link.href = URL.createObjectURL(blob);
  link.download = name;
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 60000);
}

// Files.

/// Forgets what was dropped together.
function remove(folder) {
  for (const name of goffer.FS.readdir(folder)) {
    if (name !== "." && name !== "..") goffer.FS.unlink(`${folder}/${name}`);
  }
  goffer.FS.rmdir(folder);
}

async function open_files(files) {
  const folder = `/opened${folders++}`, wanted = files.filter((file) => models.test(file.name));
  if (wanted.length === 0) return say("There is no model among these: .glb, .gltf, .obj, .ply, .stl or .goffer.", true);
  try {
    const contents = await Promise.all(files.map((file) => file.arrayBuffer()));
    goffer.FS.mkdir(folder);
    files.forEach((file, index) => goffer.FS.writeFile(`${folder}/${file.name}`, new Uint8Array(contents[index])));
  } catch (error) {
    if (goffer.FS.analyzePath(folder).exists) remove(folder);
    return say(`These cannot be read: ${error.message ?? error}`, true);
  }
  attempt_later("Opening ..", () => {
    try {
      state = ask("open", ["string"], [JSON.stringify(wanted.map((file) => `${folder}/${file.name}`))]);
    } catch (error) {
      remove(folder);
      throw error;
    }
    if (opened) remove(opened);  // until then a control that binds again reads it
    opened = folder;
    region = 0;
    state = ask("look");
  });
}

function listen_to_drops() {
  const marked = (on) => document.body.classList.toggle("dropping", on);
  window.ondragover = (event) => { event.preventDefault(); marked(true); };
  window.ondragleave = () => marked(false);
  window.ondrop = (event) => {
    event.preventDefault();
    marked(false);
    open_files([...event.dataTransfer.files]);
  };
}

// Pictures.

function draw() {
  const canvas = at("canvas"), ratio = window.devicePixelRatio || 1;
  const width = Math.max(1, Math.round(canvas.clientWidth * ratio)), height = Math.max(1, Math.round(canvas.clientHeight * ratio));
  if (canvas.width !== width || canvas.height !== height) {
    canvas.width = width;
    canvas.height = height;
  }
  const animated = at("animated").checked;
  const frame = animated ? Math.floor((performance.now() - started) * frames_per_second / 1000) : 0;
  const times = ask("draw", ["number", "number", "number", "number"], [width, height, frame, animated ? 1 : 0]);
  dirty = animated;
  const milliseconds = (value) => `${value.toFixed(value < 10 ? 2 : 0)} ms`;
  at("times").textContent = (at("shader").checked ? `set-up ${milliseconds(times.set_up)}` : `deform ${milliseconds(times.deform)}`) +
    `, upload ${milliseconds(times.upload)}`;
}

/// Where it fails, page.hpp shows less from then on; where that fails too, nothing is drawn until something changes.
function attempt_to_draw() {
  const again = !failed;
  try {
    draw();
    failed = false;
  } catch (error) {
    failed = true;
    attempt(() => { throw error; });
    dirty = again;
  }
}

function draw_on() {
  if (!page) return;
  if (dirty) {
    dirty = false;
    attempt_to_draw();
  }
  requestAnimationFrame(draw_on);
}

makeGoffer().then((module) => {
  goffer = module;
  page = goffer.ccall("goffer_page_make", "number", [], []);
  try {
    state = ask("start", ["string"], ["#canvas"]);
  } catch (error) {
    return give_up(`goffer could not be started: ${error.message}`);
  }
  listen_to_panel();
  listen_to_drops();
  listen_to_pointers();
  new ResizeObserver(() => { dirty = true; }).observe(at("canvas"));
  say("");
  show_state();
  draw_on();
}, (error) => say(`goffer could not be started: ${error}`, true));
