"""The lens in space: meshes, rays, the renderer and its widget."""
