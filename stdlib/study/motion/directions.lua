--- The six directions of the world's axes, as they are called: {name, unit vector}.
return {{"+x", clench.vec3(1, 0, 0)}, {"-x", clench.vec3(-1, 0, 0)}, {"+y", clench.vec3(0, 1, 0)},
        {"-y", clench.vec3(0, -1, 0)}, {"+z", clench.vec3(0, 0, 1)}, {"-z", clench.vec3(0, 0, -1)}}
