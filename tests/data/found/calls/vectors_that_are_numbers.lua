call("v[1] = clench.shapes.move(clench.shapes.box {1, 1, 1}, 5)", "clench.shapes.move", 1, false)
call("v[2] = clench.shapes.turn(clench.shapes.box {1, 1, 1}, 5, 1)", "clench.shapes.turn", 2, false)
call("v[3] = clench.shapes.area {vertices = {1, 2, 3}, triangles = {{1, 2, 3}}}", "clench.shapes.area", 3, false)
call("v[4] = clench.shapes.volume {vertices = {{1e300, 0, 0}, {0, 1e300, 0}, {0, 0, 1e300}}, triangles = {{1, 2, 3}}}", "clench.shapes.volume", 4, true)
