--- Metatable of the orders {seconds =, condition =} that task.wait and its siblings yield. Distinguishes them from values that a script yields.
return {__name = "task order"}
