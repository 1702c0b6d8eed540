"""Motion of wheels and struts, brakes, bogies, and all forces of a gear at once."""
