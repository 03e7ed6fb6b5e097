--- Classes of the standard library by name, as `clench.class` makes them: objects of theirs that are plain data keep their class when they
--- are handed over to another state.
return {}
