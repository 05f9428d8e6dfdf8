"""The documentation site: the handbook's pages, and beside them what is made from the sources when it is built.

`examples` runs the code that stands on pages, `pictures` takes those of the window, `generated` writes pages, `links`
finds dead links, and `hooks` hands all of it to MkDocs. Not part of the wheel.
"""
