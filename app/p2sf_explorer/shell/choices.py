"""What the palette and the menu of choices offer beside the window's own actions: panels, lenses, looks, languages."""

from functools import partial

from PySide6.QtWidgets import QMenu

from p2sf_explorer.compute.setup import shipped, title
from p2sf_explorer.i18n.language import languages
from p2sf_explorer.i18n.tr import tr
from p2sf_explorer.panels import REGISTRY
from p2sf_explorer.state.limits import CHOICES
from p2sf_explorer.state.what_if import PRESETS, of_preset
from p2sf_explorer.widgets.command import Command

COLOURS = {"standard": "Inferno", "viridis": "Viridis", "cividis": "Cividis", "grey": "Grey"}
THEMES = {"system": "As the system", "light": "Light", "dark": "Dark"}


def everything(window) -> tuple[Command, ...]:
    """Return all a person can do in a window."""
    return (*window.actions.commands, *_panels(window), *_lenses(window), *_presets(window), *looks(window))


def _panels(window):
    for entry in REGISTRY:
        if entry.place != "main":
            yield Command(entry.title, partial(window.open_panel, entry.key), (), "Panel")


def _lenses(window):
    for name in shipped():
        yield Command(title(name), partial(window.actions.open_lens, name), (), "Lens")


def _presets(window):
    for preset in PRESETS:
        yield Command(preset.title, partial(_take_preset, window, preset), (), "Preset")


def _take_preset(window, preset) -> None:
    window.store.update(**of_preset(preset))


def looks(window):
    """Yield how the window may look and speak."""
    update = window.store.update
    for value in CHOICES["colours"]:
        yield Command(COLOURS[value], partial(update, colours=value), (), "Colours")
    for value in CHOICES["theme"]:
        yield Command(THEMES[value], partial(update, theme=value), (), "Theme")
    yield Command("As the system", partial(update, language="system"), (), "Language")
    for code, name in languages().items():
        yield Command(name, partial(update, language=code), (), "Language")


def fill(menu: QMenu, window, first: tuple[Command, ...]) -> None:
    """Put actions into a menu, and under them the looks, group by group."""
    for command in first:
        keys = f"\t{command.keys[0]}" if command.keys else ""
        menu.addAction(tr(command.title) + keys, command.run)
    menu.addSeparator()
    groups: dict[str, QMenu] = {}
    for command in looks(window):
        if command.group not in groups:
            groups[command.group] = menu.addMenu(tr(command.group))
        groups[command.group].addAction(tr(command.title), command.run)
