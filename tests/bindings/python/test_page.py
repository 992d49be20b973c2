"""The page about a problem: that its parts are there, that it stands alone, and, with --long, that a browser shows it so."""

import os
import re
import shutil
from html.parser import HTMLParser
from pathlib import Path
from xml.etree import ElementTree

import numpy as np
import pytest
from conftest import pile, squeezed

import mlcp
from mlcp import page

PARTS = ["methods", "active", "islands", "sparsity"]


class Reader(HTMLParser):
    """Notes the ids, what is referred to, and whether tags match."""

    void = {"meta", "link", "br", "hr", "img", "input", "path", "use", "rect", "image"}

    def __init__(self, text):
        super().__init__()
        self.ids, self.references, self.open = [], [], []
        self.feed(text)
        self.close()
        assert not self.open

    def handle_starttag(self, tag, attributes):
        for name, value in attributes:
            if name == "id":
                self.ids.append(value)
            elif name in ("src", "href", "xlink:href", "action", "data"):
                self.references.append(value)
        if tag not in self.void:
            self.open.append(tag)

    def handle_startendtag(self, tag, attributes):
        self.handle_starttag(tag, attributes)
        if tag not in self.void:
            self.open.pop()

    def handle_endtag(self, tag):
        if tag not in self.void:
            assert self.open.pop() == tag


def check(text, parts, drawn=None):
    reader = Reader(text)
    assert [identity for identity in reader.ids if identity in {"steps", *PARTS}] == parts
    assert len(set(reader.ids)) == len(reader.ids)
    # within the page, or the data itself
    assert all(reference.startswith(("#", "data:")) for reference in reader.references)
    assert not re.search(r"url\((?!#)|@import|<script", text)
    figures = re.findall(r"<svg.*?</svg>", text, re.DOTALL)
    assert len(figures) == (drawn or len(parts))
    for figure in figures:
        assert ElementTree.fromstring(figure).get("aria-label")
    return figures


def sliding_block():
    problem = mlcp.Problem()
    (block,) = problem.add_bodies(2 * np.eye(3))
    problem.set_momentum([0.2, 0.0, -0.2])
    problem.add_contacts(body_b=[block], jacobian_b=[[[0, 0, 1], [1, 0, 0], [0, 1, 0]]], mu=0.5)
    return problem


@pytest.mark.parametrize("make", [lambda: pile(30), sliding_block, mlcp.Problem], ids=["pile", "friction", "empty"])
def test_the_page_of_a_problem_has_its_parts_and_stands_alone(make):
    check(page.page([make()], "a <b> & c", methods=["newton", "simplex"]), PARTS)


def test_the_page_of_an_infeasible_problem_says_why_there_is_no_active_set():
    text = page.page([squeezed()], "squeezed", methods=["newton"])
    assert "<td>infeasible</td>" in text and "The simplex ended with infeasible" in text
    check(text, PARTS, drawn=3)


def test_ink_follows_the_scheme_of_the_browser():
    figures = check(page.page([pile(30)], "pile", methods=["newton"]), PARTS)
    for figure in figures:
        assert "currentColor" in figure and not re.search(r"(fill|stroke): #(000000|ffffff)", figure)


def recorded(folder, steps):
    """A scene's problems as snapshots, the way step_scene leaves them."""
    folder.mkdir()
    scene = mlcp.Scene("pile", 12)
    for step in range(steps):
        scene.prepare()
        mlcp.save(folder / f"{step}.mlcp", scene.problem)
        scene.finish()


def test_a_folder_of_snapshots_is_a_scene_in_the_order_of_its_steps(tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    recorded(tmp_path / "pile", 12)
    assert page.main(["pile", "--methods", "newton"]) == 0
    assert "wrote pile.html" in capsys.readouterr().out
    check((tmp_path / "pile.html").read_text(), ["steps", *PARTS])
    rows = [problem.rows for problem in page._read(tmp_path / "pile", None)]
    assert rows == [mlcp.load(tmp_path / "pile" / f"{step}.mlcp").problem.rows for step in range(12)]


def test_what_is_no_problem_is_an_error(tmp_path, capsys):
    assert page.main([str(tmp_path)]) == 2
    assert page.main([str(tmp_path / "none.mlcp")]) == 2
    assert capsys.readouterr().err.count("mlcp.page: ") == 2


@pytest.mark.skipif("MLCP_TEST_LONG" not in os.environ, reason="a browser is large: with --long")
@pytest.mark.parametrize("scheme", ["light", "dark"])
def test_a_browser_shows_every_part_and_asks_for_nothing(tmp_path, scheme):
    from playwright.sync_api import sync_playwright

    browser_path = shutil.which("chromium")
    assert browser_path, "no chromium: tests/setup browser"
    recorded(tmp_path / "pile", 3)
    output = tmp_path / "page.html"
    assert page.main([str(tmp_path / "pile"), "--output", str(output)]) == 0
    with sync_playwright() as playwright:
        browser = playwright.chromium.launch(executable_path=browser_path, args=["--no-sandbox"])
        view = browser.new_page(viewport={"width": 1100, "height": 900}, color_scheme=scheme)
        requests, complaints = [], []
        view.on("request", lambda request: requests.append(request.url))
        view.on("console", lambda message: complaints.append(message.text))
        view.on("pageerror", lambda error: complaints.append(str(error)))
        view.goto(output.as_uri())
        for part in ["steps", *PARTS]:
            box = view.locator(f"#{part} svg").bounding_box()
            assert box["width"] > 300 and box["height"] > 100
        assert view.locator("#methods tbody tr").count() == len(page.METHODS)
        color = "getComputedStyle(document.querySelector('{}')).{}"
        ink, paper = ([int(part) for part in re.findall(r"\d+", view.evaluate(color.format(of, what)))[:3]]
                      for of, what in (("#methods svg text", "fill"), ("#methods", "backgroundColor")))
        assert (sum(ink) > 600 > 200 > sum(paper)) if scheme == "dark" else (sum(ink) < 200 < 600 < sum(paper))
        assert view.evaluate("document.documentElement.scrollWidth <= window.innerWidth")
        view.set_viewport_size({"width": 390, "height": 800})
        assert view.evaluate("document.documentElement.scrollWidth <= window.innerWidth")
        assert view.screenshot(path=tmp_path / f"{scheme}.png", full_page=True)
        browser.close()
    assert [Path(url).name for url in requests if not url.startswith("data:")] == ["page.html"] and not complaints
