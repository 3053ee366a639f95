"""Triangle meshes and flat shapes for pictures; no physics uses them."""
