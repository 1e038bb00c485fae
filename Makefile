# The short way in: make demo, make test. Everything else is CMake (see CMakePresets.json).
#
#   make          build build/release/facetmill
#   make deps     install the Debian packages that are missing (tools/deps.sh --list names them)
#   make demo     process a real scan and say where the results are, with an installed facetmill of this version, else
#                 with one that is built
#   make test     build and run all tests                    (PRESET=debug, asan, tsan or ci for other builds)
#   make asan     the same with AddressSanitizer and UndefinedBehaviorSanitizer
#   make tsan     the same with ThreadSanitizer, on plain threads in the place of TBB (slow)
#   make faults   make calls of the system fail, one in each of some thousand runs (tests/faults/faults.py)
#   make schedules   stop threads at random instructions in 1,000 runs and compare bytes (tests/faults/schedules.py)
#   make fuzz     random meshes through random chains of stages for a while (MINUTES=10, FIRST=1, the first seed);
#                 TARGET=ply and such: libFuzzer over what reads bytes, with clang (TARGET=all: each for its share)
#   make bench    build and run the benchmarks               (FILTER=clip for some of them)
#   make site     the manual as a site, in build/site/html
#   make pictures all pictures of the manual anew: those of docs/figures, which on an unchanged tree stay as they are, and
#                 those of the stages' pages and the gallery, with the site around them
#   make install  install under PREFIX (/usr/local; DESTDIR is respected)
#   make deb      the Debian packages facetmill and facetmill-doc in build/release
#   make deb-arm64   the same for arm64, in build/arm64; after make dist-arm64
#   make dist     the packages of a release in dist/: a static executable, pip, npm, image (packaging/README.md)
#                 (ARCH="x86_64 aarch64" for both architectures, as make dist-arm64)
#   make deps-windows   the libraries for 64-bit Windows, from Debian's sources, in build/libraries-windows
#   make dist-windows   as make dist, with the executable and packages for 64-bit Windows
#   make cross-check   compare outputs of the arm64 executable with those of x86-64, byte for byte
#                 (SYSTEM=windows for the executable of Windows, under Wine)
#   make reproduce   build them again from a clone of this commit, and compare the bytes with dist/
#   make test-dist   install these packages as users do, and run them (needs root for chroot)
#   make format   run clang-format over the sources
#   make check-style   the layers, clang-format, clang-tidy, and statements separated by commas

PRESET ?= release
JOBS ?= $(shell n=$$(nproc); [ $$n -gt 2 ] && echo 2 || echo $$n)
PREFIX ?= /usr/local
FILTER ?= .
MINUTES ?= 10
FIRST ?= 1
TARGET ?= stages
BUILD := build/$(PRESET)
SYSROOT ?= $(CURDIR)/build/sysroot-arm64
export CTEST_PARALLEL_LEVEL ?= $(JOBS)

.PHONY: all deps configure build tests demo test asan tsan faults schedules fuzz fuzz-stages fuzz-bytes bench site pictures install deb deb-arm64 dist dist-arm64 deps-windows dist-windows cross-check reproduce test-dist format check-layers check-style clean
all: build

deps:
	@tools/deps.sh

configure: deps
	@cmake --preset $(PRESET) --log-level=NOTICE

build: configure
	@cmake --build --preset $(PRESET) -j $(JOBS) --target facetmill manual

tests: configure
	@cmake --build --preset $(PRESET) -j $(JOBS)

# An installed facetmill of this version; empty if there is none.
INSTALLED := $(if $(filter demo,$(MAKECMDGOALS)),$(shell \
    [ "$$(facetmill --version 2>&1)" = "facetmill $$(cat VERSION)" ] && command -v facetmill))

# Else one that was built before, else one that is built in the cheapest way. All write the same bytes.
BUILT := $(wildcard $(BUILD)/facetmill)
DEMO := $(or $(INSTALLED),$(BUILT),build/demo/facetmill)

build/demo/facetmill: deps
	@cmake --preset demo --log-level=NOTICE
	@cmake --build --preset demo -j $(JOBS)

demo: $(if $(INSTALLED),,$(if $(BUILT),build,build/demo/facetmill))
	@mkdir -p out
	$(if $(INSTALLED),@echo "$(INSTALLED) is of this version and is used. make build builds from these sources.")
	$(DEMO) run quickstart -D input=examples/data/nefertiti.ply -D unit=mm -D up=y --output-dir out
	@echo
	@echo "Look at out/nefertiti.html (the report) and out/nefertiti.glb in any glTF viewer;"
	@echo "out/nefertiti.draco.glb is the same mesh compressed, out/nefertiti.json the report for programs."
	$(if $(findstring build/demo,$(DEMO)),@echo "build/demo/facetmill is slow because it was built without optimisation. make build builds a fast one.")

test: tests
	@tests/conformance/setup.sh $(BUILD)/conformance || echo "The tests go on without the glTF validator and axe-core." >&2
	@ctest --preset $(PRESET)

asan:
	@$(MAKE) --no-print-directory test PRESET=asan

tsan:
	@$(MAKE) --no-print-directory test PRESET=tsan

faults: build
	@cmake --build --preset $(PRESET) -j $(JOBS) --target facetmill_inject
	python3 tests/faults/faults.py
	python3 tests/faults/faults.py --kill
	python3 tests/faults/faults.py --stages

schedules: build
	@cmake --build --preset $(PRESET) -j $(JOBS) --target facetmill_perturb
	python3 tests/faults/schedules.py

fuzz: $(if $(filter stages,$(TARGET)),fuzz-stages,fuzz-bytes)

fuzz-stages: build
	@cmake --build --preset $(PRESET) -j $(JOBS) --target fuzz_stages
	nice -n 19 $(BUILD)/tests/fuzz_stages $$((60 * $(MINUTES))) $(FIRST)

fuzz-bytes:
	@tools/deps.sh --fuzz
	@cmake --preset fuzz --log-level=NOTICE
	@cmake --build --preset fuzz -j $(JOBS) --target fuzz_bytes
	nice -n 19 tests/fuzz/fuzz.sh build/fuzz/tests/fuzz_bytes $(TARGET) $$((60 * $(MINUTES)))

bench:
	@tools/deps.sh --bench
	@cmake --preset release -DFACETMILL_BENCH=ON --log-level=NOTICE
	@cmake --build --preset release -j $(JOBS)
	$(BUILD)/bench/facetmill_bench --benchmark_filter='$(FILTER)' --benchmark_counters_tabular=true

site: build
	@tools/deps.sh --site
	python3 tools/site/site.py build/site --mill $(BUILD)/facetmill

pictures: build
	python3 tools/pictures.py --mill $(BUILD)/facetmill
	@$(MAKE) --no-print-directory site

install: build
	cmake --install $(BUILD) --prefix $(PREFIX)

deb: build
	@tools/deps.sh --deb
	cd $(BUILD) && cpack -G DEB

deb-arm64:
	@cmake --build build/arm64 -j $(JOBS) --target facetmill manual
	cd build/arm64 && export DEB_HOST_ARCH=arm64 DPKG_ADMINDIR="$(SYSROOT)/var/lib/dpkg" \
	    LD_LIBRARY_PATH="$(SYSROOT)/usr/lib/aarch64-linux-gnu:$(SYSROOT)/lib/aarch64-linux-gnu" && cpack -G DEB

dist: deps
	@ARCH="$(ARCH)" packaging/dist.sh dist

dist-arm64:
	@$(MAKE) --no-print-directory dist ARCH="x86_64 aarch64"

deps-windows:
	@tools/deps.sh --windows
	@JOBS=$(JOBS) packaging/linux/libraries.sh build/libraries-windows windows

dist-windows:
	@$(MAKE) --no-print-directory dist ARCH="x86_64 windows"

cross-check:
	@packaging/cross_check.py dist $(if $(SYSTEM),--system $(SYSTEM))

reproduce:
	@packaging/reproduce.sh dist

test-dist:
	@packaging/test.sh dist

format:
	git ls-files 'src/*.[ch]pp' 'tests/*.[ch]pp' 'bench/*.[ch]pp' | xargs clang-format -i

check-layers:
	python3 tools/check_layers.py

check-style: check-layers configure
	python3 tools/check_style.py $(BUILD)

clean:
	rm -rf build out
