# The page that reruns the study in the reader's browser: the library compiled to WebAssembly, and the page around it in one file.

.PHONY: site test-site
# Debian's emscripten looks for its JavaScript packages where Debian's Node.js has them; others do not look there. Its libraries
# are compiled on first use, into a directory of our own if we may not write into its own.
EMSCRIPTEN = NODE_PATH=/usr/share/nodejs $(shell test -w /usr/share/emscripten/cache || echo EM_CACHE=$(CURDIR)/build/site/cache)

site/node_modules/.package-lock.json: site/package.json site/package-lock.json | $(filter site-deps,$(MAKECMDGOALS) site-deps)
	cd site && npm ci --ignore-scripts --no-audit --no-fund --loglevel=error
	@touch $@

#: make site        the page that reruns the study in the reader's browser: build/site/index.html, which opens from disk
site: site/node_modules/.package-lock.json | site-deps
	@mkdir -p build/site
	$(EMSCRIPTEN) emcmake cmake -S site -B build/site/wasm -G Ninja -DCMAKE_CXX_COMPILER_LAUNCHER= >build/site/configure.log 2>&1 \
	  || { cat build/site/configure.log; false; }
	$(EMSCRIPTEN) cmake --build build/site/wasm
	site/node_modules/.bin/tsc -p site
	node site/build.mjs build/site/wasm build/site/index.html

#: make test-site   the page in a headless Chromium: the same bytes as the executables', each part driven as a reader would
test-site: site | site-test-deps
	tools/build sampling_study exact_posterior
	node --test --test-concurrency=1 site/test/page.test.mjs
