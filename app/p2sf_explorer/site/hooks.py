"""What MkDocs calls while it builds the site."""

import re
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

from latex2mathml.converter import convert
from mkdocs.exceptions import PluginError
from mkdocs.structure.files import File, Files
from mkdocs.structure.pages import Page

from p2sf_explorer.course.sheets import sheet_languages, write_course
from p2sf_explorer.handbook.pages import FOLDER, with_formulas
from p2sf_explorer.site.generated import SHEETS, navigation, pages
from p2sf_explorer.site.links import link_faults
from p2sf_explorer.site.notebooks import SHOWN, notebook_page
from p2sf_explorer.site.pictures import MADE, WINDOW, example_pictures, lesson_states, window_pictures

WORKER = Path(__file__).parent / "iframe-worker.js"
TOKEN = re.compile(r"formulatoken(\d+)end")


def on_config(config: Any) -> Any:
    """Write the contents."""
    config.nav = navigation()
    return config


def on_files(files: Files, config: Any) -> Files:
    """Add the generated pages and every picture that is made."""
    texts = pages()
    made: dict[str, bytes] = {}
    for name in SHOWN:
        texts[f"examples/{name}.md"], pictures = notebook_page(name)
        made |= {f"made/{path}": content for path, content in pictures.items()}
    for path, text in texts.items():
        files.append(File.generated(config, path, content=text))
    files.append(File.generated(config, "javascripts/iframe-worker.js", content=WORKER.read_text(encoding="utf-8")))
    made |= {f"made/{name}": content for name, content in window_pictures(WINDOW | lesson_states())}
    made |= course_sheets()
    for page in sorted(FOLDER.glob("*.md")):
        text = page.read_text(encoding="utf-8")
        if MADE.search(text):
            made |= {f"made/{name}": content for name, content in example_pictures(text, page.name)}
    for path, content in made.items():
        files.append(File.generated(config, path, content=content))
    return files


def course_sheets() -> dict[str, bytes]:
    """Return the sheets of the course as PDF by their paths on the site, in every language."""
    made: dict[str, bytes] = {}
    for language in sheet_languages():
        with TemporaryDirectory() as folder:
            paths = [path for path in write_course(Path(folder), language) if path.suffix == ".pdf"]
            made |= {f"{SHEETS}/{language}/{path.name}": path.read_bytes() for path in paths}
    return made


def on_page_markdown(markdown: str, page: Page, **_: Any) -> str:
    """Put a word in place of each formula, which Markdown would read as its own marks."""
    page.meta["formulas"] = found = []

    def token(formula: str, block: bool) -> str:
        found.append((formula, block))
        word = f"formulatoken{len(found) - 1}end"
        return f"\n\n{word}\n\n" if block else word

    return with_formulas(markdown, token)


def on_page_content(html: str, page: Page, **_: Any) -> str:
    """Put each formula back as MathML, which browsers draw without a program or a network."""
    return TOKEN.sub(lambda word: mathml(*page.meta["formulas"][int(word[1])]), html)


def on_post_build(config: Any) -> None:
    """Refuse a site that has a dead link, or that would fetch something from the network."""
    site = Path(config.site_dir)
    (site / "404.html").unlink()  # for servers, with links that hold on a server only
    for sitemap in site.glob("sitemap.xml*"):  # empty, since the site has no address of its own
        sitemap.unlink()
    if faults := link_faults(site):
        raise PluginError("\n".join(faults))


def mathml(formula: str, block: bool) -> str:
    """Return a formula as MathML; ValueError for a command that is left as it was written."""
    made = convert(formula, display="block" if block else "inline")
    if "\\" in made or "merror" in made:
        raise ValueError(f"the formula {formula} has a command that MathML cannot be made of")
    return made
