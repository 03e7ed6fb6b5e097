--- Classes of the standard library by name, as `clench.class` makes them: their objects, if plain data, keep their class when they
--- are passed to another state.
return {}
