#!/usr/bin/env bash
# Builds the page: build/web/page, a folder that a web server can serve, or that a browser opens from where it lies.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."

bash .ci/setup web
# Where Debian has the packages of Node.js that Emscripten uses: other Node.js than Debian's do not look there.
export NODE_PATH=${NODE_PATH:+$NODE_PATH:}/usr/share/nodejs
cmake --preset web --log-level=WARNING >/dev/null
cmake --build --preset web --target goffer_page
echo "The page is $PWD/build/web/page/index.html"
