call("v[1] = clench.shapes.lathe({profile = {nil, {1, 0}, {1, 1}, {0, 1}}})", "clench.shapes.lathe", 1, false)
