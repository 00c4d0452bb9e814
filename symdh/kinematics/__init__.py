"""Robot -> exact results."""
