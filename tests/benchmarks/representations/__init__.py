"""Ways to keep all PSFs of a lens: coefficients, pictures, networks, simple shapes, rays; each with what it costs.

Each module builds one family of `Representation` over a `LensSpace`; `p2sf.studies.complete_trade` compares them.
"""
