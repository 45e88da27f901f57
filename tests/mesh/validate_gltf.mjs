// SPDX-License-Identifier: MIT
// Validates glTF and GLB files with Khronos' validator: node validate_gltf.mjs [--strict] FILE...
// Exit status: 0 no errors, nor, with --strict, warnings; 1 some (printed); 77 the validator is not installed. It is
// looked up from NODE_PATH and from build/node_modules (npm install --prefix build gltf-validator@2.0.0-dev.3.10).
import { readFileSync } from 'node:fs';
import { createRequire } from 'node:module';
import { basename, dirname, join } from 'node:path';
import { fileURLToPath } from 'node:url';

function findValidator() {
  const build = join(dirname(fileURLToPath(import.meta.url)), '../../build/');
  for (const from of [import.meta.url, join(build, 'here.js')]) {
    try {
      return createRequire(from)('gltf-validator');
    } catch (error) {
      if (error.code !== 'MODULE_NOT_FOUND') throw error;
    }
  }
  console.log('gltf-validator is not installed');
  process.exit(77);
}

const validator = findValidator();
const strict = process.argv[2] === '--strict';
const worst = strict ? 1 : 0;
let failed = false;
for (const file of process.argv.slice(strict ? 3 : 2)) {
  const outer = async (uri) => new Uint8Array(readFileSync(join(dirname(file), decodeURIComponent(uri))));
  const report = await validator.validateBytes(new Uint8Array(readFileSync(file)), {
    uri: basename(file),
    maxIssues: 0,
    externalResourceFunction: outer,
    ignoredIssues: ['IO_ERROR'],  // a texture that was missing before is missing after
  });
  const errors = report.issues.messages.filter((message) => message.severity <= worst);
  for (const error of errors.slice(0, 20)) console.log(`${file}: ${error.code} ${error.pointer ?? ''}: ${error.message}`);
  console.log(`${basename(file)}: ${report.issues.numErrors} errors, ${report.issues.numWarnings} warnings`);
  failed ||= errors.length > 0;
}
process.exit(failed ? 1 : 0);
