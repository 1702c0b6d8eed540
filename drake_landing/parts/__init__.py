"""What the parts of the airframe see during a landing: stresses, section loads, floors.

All of it is taken from the direct transient of the full model while it runs.
"""
