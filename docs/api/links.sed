# Links of the pages that the Doxyfile names, as Doxygen understands them: from a name in code to that name,
# from other words to a public header, and to these pages without anchors. Other links become text.
s#\[`([^`]*)`\]\(\.\./libs/([a-z]+)/include/[^)]*\)#[\1](@ref handway::\2::\1)#g
s#\]\(\.\./libs/[a-z]+/include/([^)]*)\)#](@ref \1)#g
s#\]\((architecture|building|collision|contributing|plugins)\.md[^)]*#](\1.page#g
s#\[([^]]*)\]\([a-z./_-]+(\.md|/)[^)]*\)#\1#g
s#\.page\)#.md)#g
