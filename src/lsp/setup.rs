//! What to add to the configuration of an editor, so that it starts the server.

/// An editor.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Editor {
    /// Helix, in `languages.toml`.
    Helix,
    /// Neovim 0.7 or later, in `init.lua`.
    Neovim,
    /// Vim 9 with yegappan/lsp, in `vimrc`.
    Vim,
    /// Emacs 29 or later with Eglot, in `init.el`.
    Emacs,
    /// Kakoune with kak-lsp, in `kakrc`.
    Kakoune,
}

impl Editor {
    /// All editors.
    pub const ALL: [Self; 5] = [
        Self::Helix,
        Self::Neovim,
        Self::Vim,
        Self::Emacs,
        Self::Kakoune,
    ];

    /// Its name in lower case.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Helix => "helix",
            Self::Neovim => "neovim",
            Self::Vim => "vim",
            Self::Emacs => "emacs",
            Self::Kakoune => "kakoune",
        }
    }

    /// The lines to add to its configuration.
    pub const fn lines(self) -> &'static str {
        match self {
            Self::Helix => HELIX,
            Self::Neovim => NEOVIM,
            Self::Vim => VIM,
            Self::Emacs => EMACS,
            Self::Kakoune => KAKOUNE,
        }
    }
}

const HELIX: &str = r##"# languages.toml
[language-server.halflight]
command = "halflight"
args = ["lsp"]

[[language]]
name = "ray"
scope = "source.ray"
file-types = ["ray"]
comment-token = "//"
language-servers = ["halflight"]

[[language]]
name = "halflight"
scope = "source.halflight"
file-types = ["dat", "test"]
comment-token = "#"
language-servers = ["halflight"]

[[language]]
name = "xml"
language-servers = ["halflight"]
"##;

const NEOVIM: &str = r#"-- init.lua
local function halflight(event)
  local config = {
    name = "halflight",
    cmd = { "halflight", "lsp" },
    root_dir = vim.fn.getcwd(),
    flags = { debounce_text_changes = 20 },
    on_attach = function(_, buffer)
      -- The interface outlines what the cursor is in.
      vim.api.nvim_create_autocmd({ "CursorMoved", "CursorMovedI" }, {
        buffer = buffer,
        callback = function()
          vim.lsp.buf.clear_references()
          vim.lsp.buf.document_highlight()
        end,
      })
    end,
  }
  if vim.lsp.start then
    vim.lsp.start(config, { bufnr = event.buf })
  else -- before 0.8
    halflight_client = halflight_client or vim.lsp.start_client(config)
    vim.lsp.buf_attach_client(event.buf, halflight_client)
  end
end
local scenes = { "*.ray", "*.dat", "*.test", "*.xml" }
vim.api.nvim_create_autocmd({ "BufReadPost", "BufNewFile", "BufFilePost" }, {
  pattern = scenes,
  callback = halflight,
})
-- Under another name it is another document.
vim.api.nvim_create_autocmd("BufFilePre", {
  pattern = scenes,
  callback = function(event)
    local all = vim.lsp.get_clients and vim.lsp.get_clients() or vim.lsp.get_active_clients()
    for _, client in ipairs(all) do
      if client.name == "halflight" then
        vim.lsp.buf_detach_client(event.buf, client.id)
      end
    end
  end,
})
"#;

const VIM: &str = r#"" vimrc, with github.com/yegappan/lsp
autocmd BufRead,BufNewFile *.ray,*.dat,*.test setfiletype halflight
autocmd User LspSetup call LspAddServer([#{
  \ name: 'halflight', filetype: ['halflight', 'xml'], path: 'halflight', args: ['lsp'] }])
"#;

const EMACS: &str = r#";; init.el
(define-derived-mode halflight-mode prog-mode "Halflight")
(add-to-list 'auto-mode-alist '("\\.\\(ray\\|dat\\|test\\)\\'" . halflight-mode))
(with-eval-after-load 'eglot
  ;; Edits of the interface are made without a question, and Emacs says when it quits.
  (setq eglot-confirm-server-initiated-edits nil)
  (add-hook 'kill-emacs-hook #'eglot-shutdown-all)
  (add-to-list 'eglot-server-programs
               '((halflight-mode nxml-mode) . ("halflight" "lsp"))))
(add-hook 'halflight-mode-hook #'eglot-ensure)
(add-hook 'nxml-mode-hook #'eglot-ensure)
"#;

const KAKOUNE: &str = r#"# kakrc, with kak-lsp
eval %sh{ kak-lsp }
set-option global lsp_auto_highlight_references true
hook global WinSetOption filetype=(halflight|xml) lsp-enable-window
hook global BufCreate .*[.](ray|dat|test) %{ set-option buffer filetype halflight }
hook -group lsp-halflight global BufSetOption filetype=(halflight|xml) %{
  set-option buffer lsp_servers %{
    [halflight]
    command = "halflight"
    args = ["lsp"]
    root_globs = [".git", ".hg"]
  }
}
"#;
