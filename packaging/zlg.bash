# Completion of zlg for bash: verbs, their options, and keys behind --set, as the program itself lists them.
_zlg() {
    local word=${COMP_WORDS[COMP_CWORD]} before=${COMP_WORDS[COMP_CWORD - 1]} words
    if [ "$before" = --set ]; then
        compopt -o nospace
        words=$(zlg --keys | sed -n -e 's/^## \[\(.*\)\]$/\1/p' -e 's/^| `\([a-z0-9_]*\)` |.*/ \1/p' |
            while IFS= read -r line; do case $line in ' '*) echo "$section.${line# }=" ;; *) section=$line ;; esac; done)
        COMPREPLY=($(compgen -W "$words" -- "$word"))
        return
    fi
    if [ "$COMP_CWORD" -gt 1 ]; then
        [ "${word#-}" != "$word" ] || return 0
        words=$(zlg help "${COMP_WORDS[1]}" 2>/dev/null | sed -n 's/^  \(-h,\)\{0,1\}\(--[a-z-]*\).*/\2/p')
    else
        words=$(zlg help | sed -n -e 's/^  \([a-z]*\) .*/\1/p' -e 's/^  \(-h,\)\{0,1\}\(--[a-z-]*\).*/\2/p')
    fi
    COMPREPLY=($(compgen -W "$words" -- "$word"))
}
complete -o default -F _zlg zlg
