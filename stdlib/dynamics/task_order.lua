--- Metatable of the orders {seconds =, condition =} that the functions of a task yield. Distinguishes them from values that a script yields.
return {__name = "task order"}
