"""What each command is in Python, which the page of the command line shows beside its help."""

PYTHON = {
    "coefficients": 'p2sf.Camera("tessar").at(field_deg=10).coefficients()',
    "psf": 'p2sf.Camera("tessar", f_number=8).at(field_deg=10).psf().save("psf.npz")',
    "tolerance": 'p2sf.Camera("achromat_f6").tolerances({"mtf20": 0.5}, builds=500).yields',
    "zernike": 'p2sf.Camera("tessar").at(field_deg=10).zernike("noll", 15)',
    "tradeoff": 'p2sf.tradeoff(p2sf.load_lens("landscape"), fields_deg=[0], methods=["seidel"], pixels=16)',
    "plan": 'p2sf.plan(p2sf.load_lens("achromat_f6"), p2sf.Scene(p2sf.Sensor(6, 8, 60.0), rtol=0.4))',
    "image": 'p2sf.Camera("achromat_f6", pixel_um=60).photograph(np.ones((6, 8)), rtol=0.4)',
    "sharpen": 'p2sf.Camera("achromat_f6", pixel_um=60).sharpen(np.full((24, 32), 0.5), noise=0.01, rtol=0.4)',
    "database": 'p2sf.Camera("tessar").database(path="tessar.npz").coefficients(field_deg=[0, 5, 10])',
    "import": 'p2sf.write_lens(p2sf.load_lens("tessar"), "tessar.zmx")',
    "measure": "p2sf.fit_psf(array, na=0.1, wavelength_nm=550, pixel_um=0.5)",
    "explore": 'p2sf.widget("tessar")',
}
"""By the command; the others have no function of the library."""


def with_python(page: str) -> str:
    """Return the page of the command line with a line of Python below the heading of each command that has one."""
    for command, line in PYTHON.items():
        heading = f"## p2sf {command}\n"
        shown = f"\nIn Python:\n\n<!-- not run: tests/explorer/site runs it -->\n```python\n{line}\n```\n"
        page = page.replace(heading, heading + shown, 1)
    return page
