"""Superelements: parts, images, external matrices, put together as one model."""
