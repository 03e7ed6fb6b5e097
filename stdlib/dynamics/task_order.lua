--- Metatable of what a task of world:spawn yields when it waits: {seconds =, condition =}. It tells them from what a script yields itself.
return {__name = "task order"}
