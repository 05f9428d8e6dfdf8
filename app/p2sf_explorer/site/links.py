"""Finds dead links in a built site, and what a page would fetch from the network."""

from html.parser import HTMLParser
from pathlib import Path
from urllib.parse import unquote, urlsplit

FETCHED = {"script", "link", "img", "iframe", "source"}  # elements whose addresses a browser opens by itself


class _Links(HTMLParser):
    """Collects the addresses that a page leads to, with their elements, and the anchors that it has."""

    def __init__(self, text: str):
        super().__init__()
        self.links: list[tuple[str, str]] = []
        self.anchors: set[str] = set()
        self.feed(text)

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        """Take one element."""
        for name, value in attrs:
            if name in ("href", "src") and value:
                self.links.append((tag, value))
            elif name == "id" and value:
                self.anchors.add(value)


def link_faults(site: Path) -> list[str]:
    """Return a line for each link to a file or anchor that is not there, and for what a page fetches from elsewhere."""
    site = site.resolve()
    pages = {path: _Links(path.read_text(encoding="utf-8")) for path in sorted(site.rglob("*.html"))}
    return [
        f"{path.relative_to(site)}: {fault} {link}"
        for path, found in pages.items()
        for tag, link in found.links
        if (fault := _fault(path, tag, link, pages))
    ]


def _fault(path: Path, tag: str, link: str, pages: dict[Path, _Links]) -> str:
    """Return what is wrong with one link, "" for nothing."""
    parts = urlsplit(link)
    if parts.scheme == "data":
        return ""
    if parts.scheme or parts.netloc:
        return "fetches from the network" if tag in FETCHED else ""
    target = (path.parent / unquote(parts.path)).resolve() if parts.path else path
    if not target.exists():
        return "no such file:"
    if parts.fragment and target in pages and unquote(parts.fragment) not in pages[target].anchors:
        return "no such anchor:"
    return ""
