"""Line elements: rods, bars, beams."""
