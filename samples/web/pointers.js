// SPDX-License-Identifier: MIT
// The mouse, pens and fingers on the picture. Comes before page.js, whose functions it calls.
"use strict";

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
    if (down.size === 2) apart = Math.max(distance(), 1);
    if (down.size > 1) {
      dragged = -1;
    } else if (down.size === 1 && event.button === 0 && !event.shiftKey && !at("animated").checked) {
      const reach = (event.pointerType === "touch" ? 60 : 30) / canvas.clientHeight;
      dragged = goffer.ccall("goffer_page_end_at", "number", ["number", "number", "number", "number"],
                             [page, ...place(event), reach]);
      if (dragged >= 0) choose(dragged);
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
      const now = Math.max(distance(), 1);
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
    if (down.size === 2) apart = Math.max(distance(), 1);
    dragged = -1;
  };
  canvas.addEventListener("webglcontextlost", () => {
    give_up("The browser has taken the picture's memory away: load the page again.");
  });
  canvas.oncontextmenu = (event) => event.preventDefault();
  canvas.addEventListener("wheel", (event) => {
    event.preventDefault();
    if (page) tell("zoom", Math.pow(1.0015, event.deltaY));
  }, { passive: false });
}
