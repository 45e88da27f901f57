// SPDX-License-Identifier: MIT
// The controls of the page. What is drawn, and how, is in page.cpp.
"use strict";

const at = (id) => document.getElementById(id);
const all = (selector) => [...document.querySelectorAll(selector)];
const frames_per_second = 60;
const models = /\.(glb|gltf|obj|ply|stl|goffer)$/i;

let goffer, page, state;
const started = performance.now();
let region = 0, dirty = true, folders = 0, opened;  // opened: the folder that the models on stage lie in

/// Calls a function of page.cpp that returns text; throws what it says is wrong.
function ask(name, types = [], values = []) {
  const answer = JSON.parse(goffer.ccall("goffer_page_" + name, "string", ["number", ...types], [page, ...values]));
  dirty = true;
  if (answer.error) throw new Error(answer.error);
  return answer;
}

function tell(name, ...values) {
  goffer.ccall("goffer_page_" + name, null, ["number", ...values.map(() => "number")], [page, ...values]);
  dirty = true;
}

function say(text, failed = false) {
  at("message").textContent = text;
  at("message").classList.toggle("failed", failed);
}

/// Does what may fail; says so where it does, and has the controls show what is.
function attempt(work) {
  try {
    say("");
    work();
  } catch (error) {
    say(error.message, true);
    state = ask("state");
  }
  show_state();
}

/// The same for what takes long: the page says so first.
function attempt_later(text, work) {
  document.body.classList.add("busy");
  say(text);
  requestAnimationFrame(() => setTimeout(() => {
    attempt(work);
    document.body.classList.remove("busy");
  }));
}

const degrees = (value) => `${Math.round(10 * value) / 10}°`;

function show_automatic(input) {
  const automatic = input.dataset.auto !== undefined && Number(input.value) <= Number(input.dataset.auto);
  const output = document.querySelector(`output[for=${input.id}]`);
  output.textContent = automatic ? "auto" : input.value;
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
  all("input[data-bind]").forEach(show_automatic);
  document.querySelector("output[for=instances]").textContent = state.instances || "one body";
  at("area_hint").hidden = !at("area").checked;
  at("wrinkles").hidden = state.baked;
  at("regions").disabled = state.baked;
  for (const input of all("input[data-one]")) input.disabled = state.instances > 0;
  show_tabs();
}

function show_tabs() {
  at("tabs").hidden = state.regions.length < 2;
  at("tabs").replaceChildren(...state.regions.map((_, index) => {
    const button = document.createElement("button");
    button.textContent = index + 1;
    button.title = `Region ${index + 1}, counted from the base`;
    button.setAttribute("aria-pressed", index === region);
    button.onclick = () => {
      region = index;
      const { angle, direction } = state.regions[index];
      attempt(() => { state = ask("bend", ["number", "number", "number"], [region, angle, direction]); });
    };
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
    input.onchange = () => attempt_later("Binding ..", () => {
      const automatic = input.dataset.auto !== undefined && Number(input.value) <= Number(input.dataset.auto);
      const value = input.type !== "range" ? input.value
        : automatic ? Number(input.dataset.autoValue) : Number(input.value);
      state = ask("bind", ["string"], [JSON.stringify({ [input.id]: value })]);
    });
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
  at("look").onclick = () => tell("look");
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
  const contents = await Promise.all(files.map((file) => file.arrayBuffer()));
  goffer.FS.mkdir(folder);
  files.forEach((file, index) => goffer.FS.writeFile(`${folder}/${file.name}`, new Uint8Array(contents[index])));
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
    tell("look");
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

// The mouse, pens and fingers.

function listen_to_pointers() {
  const canvas = at("canvas"), down = new Map();
  let dragged = -1, apart = 0;
  const place = (event) => {
    const box = canvas.getBoundingClientRect();
    return [2 * (event.clientX - box.left) / box.width - 1, 1 - 2 * (event.clientY - box.top) / box.height];
  };
  const distance = () => {
    const [a, b] = [...down.values()];
    return Math.hypot(a.clientX - b.clientX, a.clientY - b.clientY);
  };
  canvas.onpointerdown = (event) => {
    if (!page) return;
    canvas.setPointerCapture(event.pointerId);
    down.set(event.pointerId, event);
    if (down.size === 2) {
      apart = distance();
      dragged = -1;
    } else if (down.size === 1 && event.button === 0 && !event.shiftKey && !at("animated").checked) {
      const reach = (event.pointerType === "touch" ? 60 : 30) / canvas.clientHeight;
      dragged = goffer.ccall("goffer_page_end_at", "number", ["number", "number", "number", "number"],
                             [page, ...place(event), reach]);
      if (dragged >= 0) region = dragged;
    }
  };
  canvas.onpointermove = (event) => {
    const before = down.get(event.pointerId);
    if (!before) return;
    down.set(event.pointerId, event);
    const x = (event.clientX - before.clientX) / canvas.clientHeight, y = (event.clientY - before.clientY) / canvas.clientHeight;
    if (dragged >= 0) {
      attempt(() => { state = ask("drag", ["number", "number", "number"], [dragged, ...place(event)]); });
    } else if (down.size === 2) {
      const now = distance();
      tell("zoom", apart / now);
      apart = now;
      tell("pan", x, -y);
    } else if (event.shiftKey || (event.buttons & 6)) {
      tell("pan", 2 * x, -2 * y);
    } else {
      tell("orbit", -Math.PI * x, Math.PI * y);
    }
  };
  canvas.onpointerup = canvas.onpointercancel = (event) => {
    down.delete(event.pointerId);
    dragged = -1;
  };
  canvas.addEventListener("webglcontextlost", () => {
    page = undefined;
    say("The browser has taken the picture's memory away: load the page again.", true);
  });
  canvas.oncontextmenu = (event) => event.preventDefault();
  canvas.addEventListener("wheel", (event) => {
    event.preventDefault();
    if (page) tell("zoom", Math.pow(1.0015, event.deltaY));
  }, { passive: false });
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

function draw_on() {
  if (!page) return;
  if (dirty) {
    try {
      draw();
    } catch (error) {
      dirty = false;
      say(error.message, true);
    }
  }
  requestAnimationFrame(draw_on);
}

makeGoffer().then((module) => {
  goffer = module;
  page = goffer.ccall("goffer_page_make", "number", ["string"], ["#canvas"]);
  if (page === 0) return say("This browser has no WebGL 2: try a newer one, or another device.", true);
  state = ask("state");
  listen_to_panel();
  listen_to_drops();
  listen_to_pointers();
  new ResizeObserver(() => { dirty = true; }).observe(at("canvas"));
  say("");
  show_state();
  draw_on();
}, (error) => say(`goffer could not be started: ${error}`, true));
