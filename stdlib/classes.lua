--- Classes of the standard library by name, as created by `clench.class`: objects of plain data keep their class when they are passed to another state.
return {}
