call("v[191] = clench.shapes.volume({vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, triangles = {{1, 2, '3'}, {1, 2, 4}, {1, 4, 3}, {2, 3, 4}}})", "clench.shapes.volume", 191, false)
