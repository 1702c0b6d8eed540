"""Pictures of a deck: the mesh by component, its modes, a viewer without a server."""

from drake_landing.show.show import show_model as show_model
