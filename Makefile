# make check     formatting, lints and quick tests, for every change: about two minutes
# make test      everything that CI runs: formatting, lints, all tests, with C, C++ and Python as hosts
# make release-check  what a release needs beside: sanitizers, fuzzing, packages, Octave, other platforms; an hour
# make run       the NU2310 example, results in out/
# make cases     the twelve NU2310 cases, its roller profiles, the grease guide over speed, its variants and without grease, results in out/cases/
# make example   the C example, compiled and run, table in out/
# make figures   the figures of both papers beside what the library gives: docs/papers.md
# make gallery   pictures of the scenes: docs/gallery.md
# make site      the pages of docs, the C header and the Python package as one site with search, in out/site/; a dead link is an error
# make effects   cost of every effect and what it changes: docs/results/effects.md
# make cage-in-space the cage of the second paper in space: docs/results/cage-in-space.md
# make roller-space  the NU2310 with rollers in space beside those in the plane: docs/results/roller-space.md
# make waviness  orders of waves and passing of spalls beside those of textbooks: docs/results/waviness.md
# make second-paper  whirl of the second paper with elastic cage and heat balance: docs/results/second-paper.md
# make rotor-ross a rotor of ROSS on two bearings, linear and in time: docs/results/rotor-ross.md
# make verify    errors of the integration methods against CVODE: docs/results/verification.md
# make hard     hard cases with every method and preset: docs/results/hard-cases.md
# make judge     the presets on random scenes that nothing was tuned to, from SEED on, N of them
# make ellipse-rules  errors of the sums over the ellipse of a ball: docs/results/ellipse-rules.md
# make tuning    what each constant of the default method does: docs/results/tuning.md
# make random   forty thousand random scenes; about an hour
# make statistics  long runs of all methods in their statistics: docs/results/statistics.md
# make accuracy  what accuracy costs in time, beside other solvers: docs/results/accuracy.md
# make bench     time of a force evaluation and of a step, cost of roundness, throughput of cases
# make profile   what a run spends its instructions on, counted by Valgrind: docs/results/profile.md
# make build-times  what building and testing takes: docs/building.md; an hour, with PART=builds six minutes
# make header    writes include/cagedyn.h and schemas/ anew after a change
# make abi       commits to the ABI of the header anew, after it grew: ctests/abi
# make deb       a Debian package in out/
# make wheels    a Python wheel for every CPython from 3.9 on, in out/wheels/
# make wheels-test  the same, installed in empty environments without Rust, with the example of its page
# make build     library and tool, for make install
# make install   library, header, tool with manual and completions, scenes, schemas, licences and pkg-config file below
#                $(DESTDIR)$(PREFIX); libraries in LIBDIR
# make uninstall removes them

PREFIX ?= /usr/local
LIBDIR ?= $(PREFIX)/lib
DESTDIR ?=
BUILT := $(or $(CARGO_TARGET_DIR),target)/release
VERSION := $(shell sed -n 's/^version = "\(.*\)"/\1/p' Cargo.toml | head -n 1)
CARGO ?= cargo

# Python with what tests of its package need.
PYTHON := $(abspath out/venv/bin/python)

.PHONY: check test release-check tools python-env fmt lint doc shipped quick unit abi deb run cases example figures gallery site effects second-paper cage-in-space roller-space waviness rotor-ross verify hard judge tuning ellipse-rules random statistics \
	accuracy bench profile build-times header wheels wheels-test build install uninstall clean

# The same flags everywhere, so that nothing is built twice.
FLAGS := --locked --workspace --all-features

check: tools fmt lint quick

test: tools python-env fmt lint doc site shipped unit

# A tool that is missing is an error there.
release-check: tools python-env
	PYTHON=$(PYTHON) tools/release_check.sh $(STEPS)

# What a fresh Debian machine lacks. Each line says what it installs; nothing happens when it is there.
tools:
	@command -v cc >/dev/null && command -v c++ >/dev/null && command -v readelf >/dev/null \
		|| ./tools/install.sh build-essential
	@command -v cmake >/dev/null || ./tools/install.sh cmake
	@ls /usr/lib/llvm-*/lib/libclang.so >/dev/null 2>&1 || [ -n "$$LIBCLANG_PATH" ] \
		|| ./tools/install.sh libclang-dev
	@command -v valgrind >/dev/null || ./tools/install.sh valgrind
	@command -v abidw >/dev/null || ./tools/install.sh abigail-tools
	@command -v pkg-config >/dev/null || ./tools/install.sh pkg-config
	@python3 -c "import venv, ensurepip" 2>/dev/null || ./tools/install.sh python3-venv
	@$(CARGO) fmt --version >/dev/null 2>&1 || { echo "installing rustfmt"; rustup component add rustfmt; }
	@$(CARGO) clippy --version >/dev/null 2>&1 || { echo "installing clippy"; rustup component add clippy; }

python-env: out/venv/ready

out/venv/ready: python/requirements.txt
out/wheels-venv/ready: python/requirements-wheels.txt
out/site-venv/ready: docs/site/requirements.txt
out/rotor-venv/ready: python/requirements-rotor.txt

out/%/ready:
	python3 -m venv out/$*
	out/$*/bin/python -m pip install -q --disable-pip-version-check -r $^
	touch $@

# With ROSS, which brings many packages of its own.
ROTOR_PYTHON := $(abspath out/rotor-venv/bin/python)

fmt:
	$(CARGO) fmt --check

lint:
	$(CARGO) clippy $(FLAGS) --all-targets -- -D warnings

doc:
	RUSTDOCFLAGS="-D warnings" $(CARGO) doc --locked --all-features --no-deps --quiet

# What users build, without what only tests switch on.
shipped:
	$(CARGO) check --locked --quiet
	$(CARGO) check --locked --quiet --no-default-features --lib

# The programs that take seconds; see docs/building.md for the others.
quick:
	$(CARGO) test $(FLAGS) --lib --test scene --test forces --test methods --test runs

unit:
	CAGEDYN_REQUIRE_VALGRIND=1 CAGEDYN_REQUIRE_HOSTS=1 CAGEDYN_PYTHON=$(PYTHON) $(CARGO) test $(FLAGS)

run:
	$(CARGO) run --release --locked -- run scenes/nu2310.json --out out

cases:
	$(CARGO) run --release --locked -- cases scenes/nu2310_fig9.cases.json --out out/cases/nu2310
	$(CARGO) run --release --locked -- cases scenes/nu2310_profile.cases.json --out out/cases/nu2310_profile
	$(CARGO) run --release --locked -- cases scenes/grease_guide_speed.cases.json --starts 24 --out out/cases/grease_speed
	$(CARGO) run --release --locked -- cases scenes/grease_guide_effects.cases.json --starts 24 --out out/cases/grease_effects
	$(CARGO) run --release --locked -- cases scenes/grease_guide_dry.cases.json --starts 24 --out out/cases/grease_dry

FIGURES := out/figures
TOOL := $(CARGO) run --release --locked --

figures: tools
	$(TOOL) run scenes/nu2310.json --set record.duration=0.5 \
		--set 'title=NU2310, 40 µm, 4900 N, 3000 rev/min (Figs. 4 to 6)' --out $(FIGURES)/nu2310
	$(TOOL) run scenes/nu2310.json --set inner_ring.radial_clearance=5e-6 \
		--set 'title=NU2310, 5 µm, 4900 N, 3000 rev/min (Figs. 10 and 11)' --out $(FIGURES)/nu2310_5um
	$(TOOL) cases scenes/nu2310_fig9.cases.json --out $(FIGURES)/fig9
	$(TOOL) cases scenes/nu2310_unknowns.cases.json --out $(FIGURES)/unknowns
	$(TOOL) cases scenes/nu2310_inlet.cases.json --out $(FIGURES)/inlet
	$(TOOL) run scenes/grease_guide.json --starts 24 --out $(FIGURES)/grease
	$(TOOL) cases scenes/grease_guide_speed.cases.json --starts 24 --out $(FIGURES)/grease_speed
	$(TOOL) cases scenes/grease_guide_dry.cases.json --starts 24 --out $(FIGURES)/grease_dry
	$(CARGO) run --release --locked --package cagedyn-studies --bin papers -- $(FIGURES) --page docs/papers.md
	mkdir -p docs/images
	cp $(FIGURES)/nu2310/cage_orbit.svg $(FIGURES)/nu2310/cage_position.svg $(FIGURES)/nu2310/cage_spectrum.svg docs/images/
	cp $(FIGURES)/nu2310_5um/roller_history.svg $(FIGURES)/nu2310_5um/contact_forces.svg $(FIGURES)/nu2310_5um/over_orbit.svg docs/images/
	cp $(FIGURES)/fig9/cage_positions.svg $(FIGURES)/grease/whirl_history.svg $(FIGURES)/grease_speed/whirl_speed.svg docs/images/
	cp $(FIGURES)/grease/cage_orbit.svg docs/images/whirl_orbit.svg

GALLERY := out/gallery

# Scenes with the picture of their run that shows them best.
gallery: tools
	set -e; for shown in nu2310_grease/cage_orbit nu2310_space/roller_skew full_complement/contact_forces tapered_32210/line_load_map \
		angular_contact_70/contact_ellipse angular_contact_70_cage/cage_views grease_guide_elastic/cage_orbit; do \
		scene=$${shown%/*}; \
		$(TOOL) run scenes/$$scene.json --out $(GALLERY)/$$scene; \
		cp $(GALLERY)/$$shown.svg docs/images/gallery_$$scene.svg; \
	done
	$(TOOL) heat scenes/nu2310_heat.json --out $(GALLERY)/nu2310_heat
	cp $(GALLERY)/nu2310_heat/heat_flow.svg docs/images/gallery_nu2310_heat.svg
	$(TOOL) equilibrium scenes/deep_groove_6206.json --out $(GALLERY)/deep_groove_6206
	cp $(GALLERY)/deep_groove_6206/equilibrium.svg docs/images/gallery_deep_groove_6206.svg

# Warnings, among them every link that leads nowhere, are errors. All pages are read anew, for a page that is kept warns no more.
site: tools out/site-venv/ready
	rm -rf out/site
	out/site-venv/bin/python -m sphinx -q -W -E --keep-going -c docs/site -d out/site-pages . out/site

example:
	$(CARGO) build --release --locked
	ln -sf libcagedyn.so $(BUILT)/libcagedyn.so.0
	mkdir -p out
	$(CC) -std=c99 -Wall -Wextra -Wpedantic -Iinclude examples/nu2310.c -o out/nu2310 \
		-L$(BUILT) -lcagedyn -Wl,-rpath,$(abspath $(BUILT))
	./out/nu2310 scenes/nu2310.json out/nu2310.csv

second-paper: tools
	$(CARGO) run --release --locked --package cagedyn-studies --bin second_paper -- --docs

cage-in-space: tools
	$(CARGO) run --release --locked --package cagedyn-studies --bin cage_in_space -- --docs

roller-space: tools
	$(CARGO) run --release --locked --package cagedyn-studies --bin roller_space -- --docs

waviness: tools
	$(CARGO) run --release --locked --package cagedyn-studies --bin waviness -- --docs

rotor-ross: tools out/rotor-venv/ready
	$(CARGO) build --release --locked --lib
	CAGEDYN_LIBRARY=$(abspath $(BUILT)/libcagedyn.so) PYTHONPATH=python OPENBLAS_NUM_THREADS=1 \
		$(ROTOR_PYTHON) python/examples/rotor_ross docs/results/rotor-ross.md

effects: tools
	$(CARGO) run --release --locked --package cagedyn-studies --bin effects -- --docs

verify: tools
	CAGEDYN_BLESS=1 $(CARGO) test $(FLAGS) --test cvode --test methods -- --ignored --nocapture --test-threads 1 table

hard: tools
	CAGEDYN_BLESS=1 $(CARGO) test --release --locked --test hard -- --ignored --nocapture

SEED ?= 1000
N ?= 200

judge: tools
	$(CARGO) run --release --locked --package cagedyn-studies --bin judge -- --seed $(SEED) --n $(N) $(ARGS)

ellipse-rules: tools
	$(CARGO) run --release --locked --package cagedyn-studies --bin ellipse_rules > docs/results/ellipse-rules.md

# Some ten minutes.
tuning: tools
	mkdir -p docs/results
	$(CARGO) run --release --locked --package cagedyn-studies --bin judge -- --seed 0 --n 20 --tuning > docs/results/tuning.md

# Twenty times as many random scenes as every test run has; about an hour.
random: tools
	PROPTEST_CASES=20000 $(CARGO) test --release --locked --test random_scenes scenes_run_or -- --nocapture

# Valgrind needs to know where inlined code comes from.
profile: tools
	$(CARGO) run --locked --profile profiling --package cagedyn-studies --bin profile -- --docs

statistics: tools
	$(CARGO) run --release --locked --package cagedyn-studies --bin statistics -- --docs

accuracy: tools
	tools/fetch_peers.sh out/peers
	PEERS_LIB=out/peers $(CARGO) run --release --locked --package cagedyn-accuracy -- --docs

bench: tools
	$(CARGO) bench --locked

build-times: tools
	tools/build_times.sh --docs $(PART)

header:
	CAGEDYN_BLESS=1 $(CARGO) test $(FLAGS) --test interfaces --test scene -- committed

abi:
	CAGEDYN_BLESS=1 $(CARGO) test $(FLAGS) --test interfaces -- abi::

deb: build
	BUILT=$(BUILT) VERSION=$(VERSION) tools/deb.sh out

wheels: tools out/wheels-venv/ready
	PYTHON=$(abspath out/wheels-venv/bin/python) tools/wheels.sh out/wheels

wheels-test: wheels
	tools/wheels_test.sh out/wheels

# What install needs; `make` as a user, `sudo make install` builds nothing.
build:
	$(CARGO) build --release --locked

# All files are made in a folder of their own first: what fails leaves nothing half-installed.
install uninstall: export PREFIX := $(PREFIX)
install uninstall: export LIBDIR := $(LIBDIR)
install uninstall: export DESTDIR := $(DESTDIR)
install uninstall: export VERSION := $(VERSION)
install uninstall: export BUILT := $(BUILT)

install:
	tools/install_tree.sh

uninstall:
	tools/install_tree.sh --remove

clean:
	$(CARGO) clean
	rm -rf out
