call("v[1] = clench.world()", "clench.world", 1, true)
call("v[2] = v[1]:body(('x'):rep(70000))", "world:body", 2, false)
call("v[2] = v[1]:body('a\\27[2J')", "world:body", 2, false)
call("v[3] = clench.shapes.ring {0.1, ['\\27[2J'] = 1}", "clench.shapes.ring", 3, false)
