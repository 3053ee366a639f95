# Two commands do everything on a machine with Python and git: `make demo` and `make test`.

PYTHON ?= python3
VENV := .venv
BIN := $(VENV)/bin
OUT ?= out/demo

.PHONY: demo test bench format lint clean

demo: $(VENV)/installed-video
	$(BIN)/susp-mj demo --out $(OUT)
	$(BIN)/susp-mj reproduce --out $(OUT)/reproduce

test: $(VENV)/installed-test
	bash scripts/test_needs.sh
	$(BIN)/ruff check .
	$(BIN)/ruff format --check .
	$(BIN)/basedpyright
	$(BIN)/lint-imports
	$(BIN)/pytest -n auto $(PYTEST_ARGS)

bench: $(VENV)/installed-bench
	$(BIN)/python scripts/bench.py

format: $(VENV)/installed-test
	$(BIN)/ruff check --fix .
	$(BIN)/ruff format .

$(VENV)/installed-%: pyproject.toml constraints.txt scripts/make_venv.sh
	PYTHON=$(PYTHON) bash scripts/make_venv.sh $(VENV)
	$(BIN)/python -m pip install --quiet --constraint constraints.txt --editable ".[$*]"
	touch $@

clean:
	rm -rf $(VENV) out dist .pytest_cache .ruff_cache .hypothesis
