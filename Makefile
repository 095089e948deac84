# The front door. Every target first installs the Debian packages that are missing (scripts/setup.sh: silent and
# offline when nothing is), then leaves the work to CMake; see CMakePresets.json for the builds behind it.

.DEFAULT_GOAL := help
.PHONY: help build test demo bench bench-wasm studio clean

CMAKE_OPTIONS ?=

help: ## this list
	@sed -n 's/^\([a-z]*\):.*## /  make \1\t/p' $(MAKEFILE_LIST) | expand -t 18

build: ## the program: build/release/surefoot
	@scripts/setup.sh build
	cmake --preset release -DSUREFOOT_BUILD_TESTS=OFF $(CMAKE_OPTIONS)
	cmake --build --preset release
	@echo "the program is build/release/surefoot"

test: ## build everything and run every test
	@scripts/setup.sh build test
	cmake --preset release -DSUREFOOT_BUILD_TESTS=ON $(CMAKE_OPTIONS)
	cmake --build --preset release
	@scripts/test.sh release

demo: build ## the main job on the built-in character: blend space, report, a walk over hills; needs no clips
	@scripts/demo.sh build/release/surefoot out/demo

bench: ## build and run the benchmarks
	@scripts/setup.sh build bench
	cmake --preset release -DSUREFOOT_BUILD_BENCH=ON $(CMAKE_OPTIONS)
	cmake --build --preset release
	@scripts/bench.sh build/release

bench-wasm: ## the same frames as WebAssembly and natively for x86-64-v2; needs Node and emscripten
	@scripts/setup.sh build bench studio
	cmake --preset release -B build/v2 -DSUREFOOT_BUILD_BENCH=ON -DSUREFOOT_BUILD_TESTS=OFF \
	  -DSUREFOOT_KERNELS_X86_64=OFF -DCMAKE_CXX_FLAGS=-march=x86-64-v2
	cmake --build build/v2 --target bench_frames
	cmake --preset wasm -DSUREFOOT_BUILD_BENCH=ON
	cmake --build build/wasm --target bench_frames
	@node scripts/bench_wasm.mjs build/v2 build/wasm

studio: ## the web studio: build/studio, which `surefoot studio` serves; needs Node and emscripten
	@scripts/setup.sh build studio
	cmake --preset wasm
	cmake --build --preset wasm
	cd apps/studio && npm run --silent build
	@echo "the studio is in build/studio; show it with: build/release/surefoot studio [PROJECT]"

clean: ## remove what was built
	rm -rf build out
