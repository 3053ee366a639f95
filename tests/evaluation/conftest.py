"""A real browser for the tests of pages."""

from __future__ import annotations

import shutil
from types import SimpleNamespace

import pytest

ARGUMENTS = [
    "--no-sandbox",
    "--disable-gpu",
    "--disable-quic",
    "--no-first-run",
    "--disable-background-networking",
    "--disable-component-update",
    "--disable-sync",
]


@pytest.fixture(scope="module")
def browser():
    from playwright.sync_api import sync_playwright

    program = next(filter(None, map(shutil.which, ("chromium", "chromium-browser", "google-chrome"))), None)
    if program is None:
        pytest.fail(
            "no chromium, chromium-browser or google-chrome on the PATH: pages cannot be tested in a real "
            "browser; install one"
        )
    with sync_playwright() as playwright:
        running = playwright.chromium.launch(executable_path=program, args=ARGUMENTS)
        yield running
        running.close()


@pytest.fixture
def visit(browser):
    """Opens a page and keeps what it said and asked for."""
    pages = []

    def open_page(path, scheme="light", width=1200, media="screen"):
        page = browser.new_page(color_scheme=scheme, viewport={"width": width, "height": 900})
        pages.append(page)
        seen = SimpleNamespace(page=page, said=[], asked=[])
        page.on("console", lambda message: seen.said.append(message.text))
        page.on("pageerror", lambda error: seen.said.append(str(error)))
        page.on("request", lambda request: seen.asked.append(request.url))
        page.emulate_media(media=media, color_scheme=scheme)
        page.goto(path.as_uri(), wait_until="load")
        return seen

    yield open_page
    for page in pages:
        page.close()
