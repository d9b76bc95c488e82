# Scanbench. Two commands are all one needs: `make run` and `make test`.
#
# What has been set up leaves a stamp file behind that is newer than the lock file it came from, so a second start takes seconds.

SHELL := bash
.SHELLFLAGS := -euo pipefail -c
.DELETE_ON_ERROR:
MAKEFLAGS += --no-print-directory
.DEFAULT_GOAL := help

PYTHON ?= python3
VENV := .venv
BIN := $(abspath $(VENV))/bin
PIP := $(BIN)/python -m pip --quiet --disable-pip-version-check --no-input
NPM := npm --loglevel=error --no-fund --no-audit --no-update-notifier

# One worker more than there are cores: a test that waits for a server leaves its core to another one.
PYTEST = -m pytest --quiet --numprocesses $$(($$(nproc) + 1)) --maxprocesses 5 --dist loadfile --no-loadscope-reorder

# The tests start hundreds of processes of Python: where bytecode may not be kept, each of them would compile its sources again.
unexport PYTHONDONTWRITEBYTECODE

# Arguments for the server: make run ARGS="--port 9000"
ARGS ?=

# The help of the page is made from the documentation.
SOURCES = $(shell find frontend/src frontend/public frontend/index.html frontend/vite.config.ts frontend/helpPages.ts docs/*.md docs/problems models/*.md CHANGELOG.md -type f 2>/dev/null)
NODE_ROOTS := $(patsubst %/package-lock.json,%,$(wildcard frontend/package-lock.json frontend/tools/package-lock.json e2e/package-lock.json vscode/package-lock.json))

.PHONY: help setup setup-test run test check coverage bench bench-ui shots lock clean
.PHONY: fuzz features nightly nightly-unit nightly-e2e
.PHONY: lint types layers unit adapter wire wire-check frontend-check frontend-unit frontend-build e2e
.PHONY: tools-python tools-node system-chromium system-fonts system-postgresql system-git system-clients

help:
	@echo "make run     set up what is missing, start the bench, print its address (ARGS=\"--port 9000\")"
	@echo "make test    lint, types, layers, unit and case tests, frontend, the main browser stories"
	@echo "make check   lint, types and layers only"
	@echo "make nightly what \`make test\` leaves out to stay quick: slow tests, the other browser stories, far more random programs"
	@echo "make coverage  how much of the backend its tests run, and which files less than 80 %"
	@echo "make bench   time the native engine beside C, builds, live values, pace, time travel, many PLCs"
	@echo "make bench-ui  what opening the page costs: bytes, time to the first live value, frames; and a large ladder"
	@echo "make fuzz    compare the engines on fresh random programs, and on ladders, diagrams and charts: N of each (N=100000, SEED=1 to begin with)"
	@echo "make features  write the pages of docs/ that are generated (features, standard library, REST API), and the shapes of the client"
	@echo "make shots   take the README's screenshots again"
	@echo "make wire    generate the browser's types from the backend's messages"
	@echo "make lock    resolve the dependencies again and write the lock files"
	@echo "make clean   remove everything that make has made"

# ------------------------------------------------------------------------------------------------ run and test
setup: $(VENV)/.stamp-runtime frontend/dist/.stamp

setup-test: $(VENV)/.stamp-runtime $(VENV)/.stamp-dev $(NODE_ROOTS:%=%/node_modules/.stamp) system-chromium system-postgresql system-git system-clients

run: setup
	@exec $(BIN)/scanbench serve $(ARGS)

# Most of the first ones keep one core at work: together they keep all.
test: setup-test
	@.ci/steps lint+layers+types+adapter+wire-check+frontend-check+frontend-build frontend-unit unit e2e

check: $(VENV)/.stamp-runtime $(VENV)/.stamp-dev $(NODE_ROOTS:%=%/node_modules/.stamp)
	@.ci/steps lint+layers+types+wire-check+frontend-check

# Tracing lines makes the tests take two fifths longer, so this is no step of `make test`.
coverage: $(VENV)/.stamp-dev system-postgresql system-git
	@cd backend && $(BIN)/python -m coverage erase
	@cd backend && $(BIN)/python -m coverage run $(PYTEST) $(ARGS)
	@cd backend && $(BIN)/python -m coverage combine --quiet && $(BIN)/python -m coverage json --quiet \
	  && $(BIN)/python -m tests.covered coverage.json

bench: $(VENV)/.stamp-runtime
	@cd backend && $(BIN)/python -m bench $(ARGS)
	@cd backend && $(BIN)/python -m bench watch
	@cd backend && $(BIN)/python -m bench pace
	@cd backend && $(BIN)/python -m bench goto
	@cd backend && $(BIN)/python -m bench instances

bench-ui: setup-test frontend/dist/.stamp
	@cd e2e && node bench/load.mjs
	@cd e2e && node bench/drawing.mjs

N ?= 10000
SEED ?=
fuzz: $(VENV)/.stamp-dev
	@cd backend && $(BIN)/python -m tests.programs $(N) $(SEED)
	@cd backend && $(BIN)/python -m tests.drawings $(N) $(SEED)

features: $(VENV)/.stamp-dev
	@cd backend && $(BIN)/python -m tests.features && $(BIN)/python -m tests.standard_page && $(BIN)/python -m tests.api_page && $(BIN)/python -m tests.client_shapes

shots: setup-test frontend/dist/.stamp system-fonts
	@cd e2e && $(NPM) run shots

# ------------------------------------------------------------------------------------------------ the steps of a test
lint:
	@cd backend && $(BIN)/ruff check --quiet . && $(BIN)/ruff format --quiet --check .

types:
	@cd backend && $(BIN)/mypy

layers:
	@cd backend && $(BIN)/lint-imports --no-logo

unit:
	@cd backend && $(BIN)/python $(PYTEST)

# The debug adapter, with a client that is not ours.
adapter:
	@cd vscode && $(NPM) run --silent check && $(NPM) run --silent test

# The browser's types come from the backend's messages; `wire` writes them, `wire-check` finds them out of date.
wire: $(VENV)/.stamp-runtime frontend/tools/node_modules/.stamp
	@$(BIN)/python -m scanbench.web.openapi frontend/tools/node_modules/openapi.json
	@cd frontend/tools && node generate.mjs node_modules/openapi.json $(WIRE_TARGET)

wire-check:
	@$(MAKE) wire WIRE_TARGET=node_modules/messages.gen.ts >/dev/null
	@cmp -s frontend/tools/node_modules/messages.gen.ts frontend/src/wire/messages.gen.ts \
	  || { echo "frontend/src/wire/messages.gen.ts is out of date: make wire" >&2; exit 1; }

frontend-check:
	@cd frontend && $(NPM) run --silent check
	@cd e2e && $(NPM) run --silent check

frontend-unit:
	@cd frontend && $(NPM) run --silent test

frontend-build: frontend/dist/.stamp

e2e: frontend/dist/.stamp
	@cd e2e && $(NPM) run --silent test

# What `make test` leaves out to stay quick: see backend/tests/amounts.py and e2e/README.md.
nightly: setup-test frontend/dist/.stamp
	@.ci/steps nightly-unit nightly-e2e

nightly-unit:
	@cd backend && SCANBENCH_NIGHTLY=1 $(BIN)/python $(PYTEST) -rs -m "nightly or slow or hypothesis"

nightly-e2e: frontend/dist/.stamp
	@cd e2e && $(NPM) run --silent nightly

# ------------------------------------------------------------------------------------------------ Python
tools-python:
	@command -v $(PYTHON) >/dev/null || { echo "Python is missing: install Python 3.11 or newer (apt install python3 python3-venv), or name one: make PYTHON=/path/to/python" >&2; exit 1; }
	@$(PYTHON) -c 'import sys; sys.exit(sys.version_info < (3, 11))' || { echo "$$($(PYTHON) --version) is too old: Scanbench needs Python 3.11 or newer. Name another one: make PYTHON=/path/to/python" >&2; exit 1; }
	@$(PYTHON) -c 'import venv, ensurepip' 2>/dev/null || { echo "This Python cannot make virtual environments: install its venv module (apt install python3-venv)" >&2; exit 1; }

$(VENV)/.stamp-venv: | tools-python
	@echo "setting up: virtual environment in $(VENV)"
	@$(PYTHON) -m venv $(VENV)
	@touch $@

# The package itself comes last, without the network: its build backend is among the locked dependencies.
$(VENV)/.stamp-runtime: backend/requirements.lock backend/pyproject.toml $(VENV)/.stamp-venv
	@echo "setting up: Python dependencies"
	@$(PIP) install --require-hashes -r backend/requirements.lock
	@$(PIP) install --no-deps --no-build-isolation -e backend
	@touch $@

$(VENV)/.stamp-dev: backend/requirements-dev.lock $(VENV)/.stamp-runtime
	@echo "setting up: Python tools for the tests"
	@$(PIP) install --require-hashes -r backend/requirements-dev.lock
	@touch $@

# ------------------------------------------------------------------------------------------------ Node
tools-node:
	@command -v node >/dev/null && command -v npm >/dev/null || { echo "Node is missing: install Node 20 or newer with npm" >&2; exit 1; }
	@node -e 'process.exit(parseInt(process.versions.node) < 20 ? 1 : 0)' || { echo "Node $$(node --version) is too old: Scanbench needs Node 20 or newer" >&2; exit 1; }

%/node_modules/.stamp: %/package-lock.json %/package.json | tools-node
	@echo "setting up: $* packages"
	@cd $* && $(NPM) ci >/dev/null
	@touch $@

frontend/dist/.stamp: frontend/node_modules/.stamp $(SOURCES)
	@echo "setting up: frontend build"
	@cd frontend && $(NPM) run --silent build -- --logLevel error
	@touch $@

# ------------------------------------------------------------------------------------------------ what the tests need from the system
# apt_install NAME,PACKAGES: with apt and as root it is installed, otherwise the message says what to do.
define apt_install
if [ "$$(id -u)" = 0 ] && command -v apt-get >/dev/null; then \
  echo "setting up: $(1) (apt)"; \
  log=$$(mktemp); \
  { apt-get update -qq && DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends $(2); } >"$$log" 2>&1 \
    || { cat "$$log" >&2; echo "$(1) could not be installed; try: apt-get install $(2)" >&2; exit 1; }; \
  rm -f "$$log"; \
else \
  echo "$(1) is missing, and the tests need it. Install it: sudo apt-get install $(2)" >&2; exit 1; \
fi
endef

system-chromium:
	@[ -x "$${CHROMIUM:-}" ] || command -v chromium >/dev/null || { $(call apt_install,Chromium,chromium fonts-dejavu-core fonts-noto-core); }

# Pictures in Japanese need its letters; no test does.
system-fonts:
	@fc-list :lang=ja 2>/dev/null | grep -q . || { $(call apt_install,Japanese fonts,fonts-noto-cjk); }

system-postgresql:
	@compgen -G '/usr/lib/postgresql/*/bin/initdb' >/dev/null || command -v initdb >/dev/null || { $(call apt_install,PostgreSQL,postgresql); }

system-git:
	@command -v git >/dev/null || { $(call apt_install,git,git); }

# Clients of protocols that are not ours: the tests connect them to a virtual PLC.
system-clients:
	@command -v nmap >/dev/null && command -v mbpoll >/dev/null && test -x /usr/sbin/mosquitto || { $(call apt_install,nmap and mbpoll and mosquitto,nmap mbpoll mosquitto); }

# ------------------------------------------------------------------------------------------------ upkeep
COMPILE = ../.lock-venv/bin/pip-compile --quiet --upgrade --generate-hashes --strip-extras --allow-unsafe \
  --no-header --no-emit-index-url --no-emit-trusted-host --no-emit-find-links

lock: | tools-python tools-node
	@$(PYTHON) -m venv .lock-venv
	@.lock-venv/bin/python -m pip --quiet --disable-pip-version-check install pip-tools
	@cd backend && $(COMPILE) -o requirements.lock requirements.in
	@cd backend && $(COMPILE) -o requirements-dev.lock requirements-dev.in
	@for root in $(NODE_ROOTS); do (cd $$root && $(NPM) install --package-lock-only); done
	@echo "lock files written; now: make test"

clean:
	@rm -rf $(VENV) .lock-venv frontend/dist $(NODE_ROOTS:%=%/node_modules) e2e/test-results e2e/playwright-report backend/.coverage* backend/coverage.json
	@find backend -type d \( -name __pycache__ -o -name '.*_cache' -o -name .hypothesis \) -prune -exec rm -rf {} +
