"""Save the present lens as a file, in the format of its ending."""

from pathlib import Path

from PySide6.QtWidgets import QWidget

from p2sf.errors import P2SFError
from p2sf.lensfile.writing import write_lens
from p2sf.messages import Message
from p2sf_explorer.compute.setup import built_lens
from p2sf_explorer.files.asking import ask_path
from p2sf_explorer.i18n.tr import tr
from p2sf_explorer.state.state import change
from p2sf_explorer.store.store import Store

KINDS = "P2SF lens (*.toml);;Zemax (*.zmx);;CODE V (*.seq);;ISET lens (*.json)"


def save_lens(store: Store, path: str) -> bool:
    """Write the present lens, say so or say why not, and return whether it was written.

    It is written as it is built, with its errors. A .toml file holds the lens exactly, so the state then names that
    file; the other formats may not.
    """
    try:
        write_lens(built_lens(store.state), path)
    except P2SFError as error:
        store.refused.emit(error)
        return False
    if Path(path).suffix.lower() == ".toml":
        store.replace(change(store.state, lens=str(Path(path).resolve()), lens_text=None, errors=()))
    store.said.emit(Message("Saved {name}", name=Path(path).name))
    return True


def ask_save_lens(parent: QWidget, store: Store) -> None:
    """Ask for a name and save the lens."""
    first = f"{Path(store.state.optics.lens).stem}.toml"
    if path := ask_path(parent, tr("Save the lens"), first, tr(KINDS)):
        save_lens(store, path)
