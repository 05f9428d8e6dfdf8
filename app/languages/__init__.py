"""The languages of the window: one Qt .ts file each in this folder, as Qt Linguist writes them; English needs none.

Adding a language is adding a file: copy ``de.ts``, name it after the language, translate it.
"""

from pathlib import Path
from xml.etree import ElementTree

from PySide6.QtCore import QCoreApplication, QLibraryInfo, QLocale, QTranslator

from app.words import CONTEXT, forget

FOLDER = Path(__file__).parent
ENGLISH = "en"


class Spoken(QTranslator):
    """A language read from its .ts file: no compiled file has to be kept beside it."""

    def __init__(self, code: str, parent=None):
        super().__init__(parent)
        self.code, self.texts = code, texts(code)

    def translate(self, context, source, disambiguation=None, n=-1) -> str:
        """Return the translation of one of our texts; nothing for Qt's own and for what is not there."""
        return self.texts.get(source, "") if context == CONTEXT else ""

    def isEmpty(self) -> bool:
        """Return whether there is nothing in it: Qt asks before it installs."""
        return not self.texts


def texts(code: str) -> dict[str, str]:
    """Return what a language says for each English text; nothing for English."""
    path = FOLDER / f"{code}.ts"
    if not path.is_file():
        return {}
    messages = ElementTree.parse(path).iter("message")
    said = {message.findtext("source"): message.findtext("translation") for message in messages}
    return {source: text for source, text in said.items() if source and text}


def languages() -> dict[str, str]:
    """Return the languages there are, code → its name in itself, English first."""
    codes = [ENGLISH, *sorted(path.stem for path in FOLDER.glob("*.ts"))]
    return {code: QLocale(code).nativeLanguageName().capitalize() for code in codes}


def chosen(choice: str) -> str:
    """Return the language meant by a State's ``language``: the system's for "system", English where there is none."""
    code = QLocale.system().name().split("_")[0] if choice == "system" else choice
    return code if (FOLDER / f"{code}.ts").is_file() else ENGLISH


def spoken() -> str:
    """Return the language the application speaks now."""
    found = QCoreApplication.instance().findChild(Spoken)
    return found.code if found else ENGLISH


def speak(choice: str) -> None:
    """Have everything that is built from now on speak a language; Qt's own words go with it."""
    code, application = chosen(choice), QCoreApplication.instance()
    if code == spoken():
        return
    for translator in application.findChildren(QTranslator):
        application.removeTranslator(translator)
        translator.setParent(None)
    if code != ENGLISH:
        own = QTranslator(application)
        own.load(f"qtbase_{code}", QLibraryInfo.path(QLibraryInfo.LibraryPath.TranslationsPath))
        for translator in (own, Spoken(code, application)):
            application.installTranslator(translator)
    forget()
