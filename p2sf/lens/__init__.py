"""The lens and the point source as plain frozen data: surfaces, media, sensor, aperture. Nothing here traces a ray."""
