"""Requirements of a scene on a lens model, and a plan for the cheapest model that meets them."""
