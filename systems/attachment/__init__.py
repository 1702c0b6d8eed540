"""How the airframe holds the landing gears."""
