// SPDX-License-Identifier: MIT
// A Chromium without a display, driven through a pipe by its DevTools protocol.
import { spawn } from "node:child_process";
import { existsSync, mkdtempSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";

const names = ["chromium", "chromium-browser", "google-chrome"];

/// The program, or nothing where there is none.
export function find_chromium() {
  for (const folder of (process.env.PATH ?? "").split(":"))
    for (const name of names) if (existsSync(join(folder, name))) return join(folder, name);
  return undefined;
}

export class Browser {
  #process;
  #folder = mkdtempSync(join(tmpdir(), "goffer-chromium-"));
  #waiting = new Map();
  #last = 0;
  #text = "";
  #session;
  complaints = [];  // errors and warnings in the console, exceptions

  constructor(program, width, height, touch) {
    this.#process = spawn(program, [
      "--headless=new", "--no-sandbox", "--disable-gpu-sandbox", "--use-angle=swiftshader", "--enable-unsafe-swiftshader",
      "--no-first-run", "--disable-extensions", "--disable-background-networking", "--disable-dev-shm-usage", "--hide-scrollbars",
      `--user-data-dir=${this.#folder}`, "--remote-debugging-pipe", "about:blank"],
      { stdio: ["ignore", "ignore", "ignore", "pipe", "pipe"] });
    this.#process.stdio[4].setEncoding("utf8");
    this.#process.stdio[4].on("data", (text) => this.#take(text));
    this.#process.on("exit", () => {
      for (const { reject } of this.#waiting.values()) reject(new Error("the browser has ended"));
    });
    this.size = { width, height, touch };
  }

  #take(text) {
    this.#text += text;
    for (let end; (end = this.#text.indexOf("\0")) >= 0; this.#text = this.#text.slice(end + 1)) {
      const message = JSON.parse(this.#text.slice(0, end));
      if (message.id) {
        const { resolve, reject } = this.#waiting.get(message.id);
        this.#waiting.delete(message.id);
        if (message.error) reject(new Error(message.error.message));
        else resolve(message.result);
      } else {
        this.#hear(message);
      }
    }
  }

  #hear({ method, params }) {
    if (method === "Runtime.exceptionThrown")
      this.complaints.push(params.exceptionDetails.exception?.description ?? params.exceptionDetails.text);
    if (method === "Runtime.consoleAPICalled" && ["error", "warning", "assert"].includes(params.type))
      this.complaints.push(params.args.map((value) => value.value ?? value.description).join(" "));
    if (method === "Log.entryAdded" && ["error", "warning"].includes(params.entry.level))
      this.complaints.push(`${params.entry.text} ${params.entry.url ?? ""}`);
  }

  send(method, params = {}) {
    const id = ++this.#last;
    const message = { id, method, params, ...(this.#session ? { sessionId: this.#session } : {}) };
    this.#process.stdio[3].write(JSON.stringify(message) + "\0");
    return new Promise((resolve, reject) => this.#waiting.set(id, { resolve, reject }));
  }

  async open(url) {
    const { targetId } = await this.send("Target.createTarget", { url: "about:blank" });
    const { sessionId } = await this.send("Target.attachToTarget", { targetId, flatten: true });
    this.#session = sessionId;
    for (const domain of ["Runtime", "Log", "Page", "DOM"]) await this.send(`${domain}.enable`);
    const { width, height, touch } = this.size;
    await this.send("Emulation.setDeviceMetricsOverride",
                    { width, height, deviceScaleFactor: touch ? 2 : 1, mobile: touch });
    await this.send("Emulation.setTouchEmulationEnabled", { enabled: touch });
    await this.send("Page.navigate", { url });
    await this.until(`location.href === ${JSON.stringify(url)} && document.readyState === "complete"`);
  }

  /// The value of an expression in the page.
  async value(expression) {
    const { result, exceptionDetails } =
      await this.send("Runtime.evaluate", { expression, awaitPromise: true, returnByValue: true });
    if (exceptionDetails) throw new Error(exceptionDetails.exception?.description ?? exceptionDetails.text);
    return result.value;
  }

  /// Waits until an expression in the page is true.
  async until(expression, seconds = 60) {
    const end = Date.now() + 1000 * seconds;
    while (Date.now() < end) {
      if (await this.value(expression)) return;
      await new Promise((resolve) => setTimeout(resolve, 50));
    }
    throw new Error(`not within ${seconds} s: ${expression}`);
  }

  async mouse(type, x, y, more = {}) {
    await this.send("Input.dispatchMouseEvent", { type, x, y, button: "left", buttons: type === "mouseReleased" ? 0 : 1,
                                                  clickCount: 1, ...more });
  }

  /// A PNG of what is seen.
  async screenshot() {
    return Buffer.from((await this.send("Page.captureScreenshot", { format: "png" })).data, "base64");
  }

  async close() {
    const ended = new Promise((resolve) => this.#process.on("exit", resolve));
    await Promise.race([this.send("Browser.close").catch(() => {}), ended]);
    setTimeout(() => this.#process.kill("SIGKILL"), 5000).unref();
    await ended;
    rmSync(this.#folder, { recursive: true, force: true, maxRetries: 5, retryDelay: 200 });
  }
}
