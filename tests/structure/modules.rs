//! The modules of a crate, one a file, and which names of which others each of them uses.
//!
//! What counts as use:
//! - A file uses another one when its code names an item that is defined there, by a path or an import, however it came by the
//!   name: an item that a parent re-exports belongs to the file that defines it.
//! - A parent that declares modules and re-exports their items uses none of them by that. It does where its own code names one.
//! - A method counts where a file adds functions to a type of another file (an `impl` block of its own): the file that
//!   defines the type uses that file if it calls one of these functions, and that file uses the one with the type.
//! - Methods of other types are called without a name of their file and do not count; the type was named somewhere.
//! - Tests do not count.

use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};

use super::functions::functions;
use super::text::{Token, closing, tokens};

/// Path of a module below the root of its crate.
type ModulePath = Vec<String>;

/// A source file that is a module.
pub(super) struct Module {
    /// The file, below the folder of sources.
    pub(super) file: PathBuf,
    /// Its code, tests left out.
    pub(super) tokens: Vec<Token>,
    imports: Vec<Import>,
}

/// A name that `use` brings into a module.
struct Import {
    /// The path as it is written.
    path: Vec<String>,
    name: String,
    /// Whether others may use it as if it were defined here.
    is_public: bool,
    /// Its place among the tokens.
    place: std::ops::Range<usize>,
}

/// The modules of one tree: of a library or of a program.
pub(super) struct Tree {
    modules: BTreeMap<ModulePath, Module>,
}

impl Tree {
    /// The modules that are declared from a root file on; `read` gives the text of a file, or none if there is no such file.
    pub(super) fn read(root: &Path, read: &dyn Fn(&Path) -> Option<String>) -> Self {
        let mut tree = Self {
            modules: BTreeMap::new(),
        };
        tree.add(Vec::new(), root.to_owned(), read);
        tree
    }

    fn add(&mut self, path: ModulePath, file: PathBuf, read: &dyn Fn(&Path) -> Option<String>) {
        let Some(text) = read(&file) else {
            panic!("{} is declared as a module", file.display());
        };
        let tokens = tokens(&text);
        let stem = file.file_stem().unwrap().to_str().unwrap();
        let folder = match stem {
            "lib" | "main" | "mod" => file.parent().unwrap().to_owned(),
            _ => file.with_extension(""),
        };
        for declared in declared_modules(&tokens) {
            let below = [path.clone(), vec![declared.clone()]].concat();
            let alone = folder.join(format!("{declared}.rs"));
            let child = if read(&alone).is_some() {
                alone
            } else {
                folder.join(&declared).join("mod.rs")
            };
            self.add(below, child, read);
        }
        let imports = imports(&tokens);
        let module = Module {
            file,
            tokens,
            imports,
        };
        self.modules.insert(path, module);
    }

    /// The modules, parents before children.
    pub(super) fn modules(&self) -> impl Iterator<Item = &Module> {
        self.modules.values()
    }

    /// Circles of files: those that use each other, directly or through others, with a name for each use among them.
    pub(super) fn circles(&self) -> Vec<Circle> {
        let uses = self.uses();
        let reached: BTreeMap<&ModulePath, BTreeSet<&ModulePath>> =
            (self.modules.keys().map(|path| (path, reached(path, &uses)))).collect();
        let mut circles: Vec<Circle> = Vec::new();
        let mut seen = BTreeSet::new();
        for path in self.modules.keys() {
            let around = |other: &&ModulePath| reached[other].contains(path);
            let circle: Vec<_> = reached[path].iter().copied().filter(around).collect();
            if !circle.is_empty() && seen.insert(circle.clone()) {
                circles.push(self.circle(&circle, &uses));
            }
        }
        circles
    }

    fn circle(&self, paths: &[&ModulePath], uses: &Uses) -> Circle {
        let file = |path: &ModulePath| self.modules[path].file.clone();
        let mut because = Vec::new();
        for from in paths {
            for (to, names) in &uses[*from] {
                if paths.contains(&to) {
                    let names: Vec<&str> = names.iter().map(String::as_str).collect();
                    let [from, to] = [file(from), file(to)];
                    because.push(format!(
                        "{} uses {} of {}",
                        from.display(),
                        names.join(", "),
                        to.display()
                    ));
                }
            }
        }
        Circle {
            files: paths.iter().map(|path| file(path)).collect(),
            because,
        }
    }

    fn uses(&self) -> Uses {
        let mut uses: Uses = (self.modules.keys())
            .map(|path| (path.clone(), BTreeMap::new()))
            .collect();
        for (path, module) in &self.modules {
            let mut add = |to: Option<ModulePath>, name: &str| {
                if let Some(to) = to.filter(|to| to != path) {
                    let names = uses.get_mut(path).unwrap().entry(to).or_default();
                    names.insert(name.to_owned());
                }
            };
            for import in &module.imports {
                if !import.is_public || module.names(&import.name) {
                    add(self.home(path, &import.path), &import.name);
                }
            }
            for used in module.paths() {
                add(self.home(path, &used), &used.join("::"));
            }
        }
        self.add_methods(&mut uses);
        uses
    }

    /// Adds the calls of functions that another file adds to a type of this one.
    fn add_methods(&self, uses: &mut Uses) {
        for (path, module) in &self.modules {
            for (on, added) in impl_blocks(&module.tokens) {
                let Some(home) = self.home(path, &[on]).filter(|home| home != path) else {
                    continue;
                };
                let called = added.iter().filter(|name| self.modules[&home].calls(name));
                let called: BTreeSet<String> = called.cloned().collect();
                if !called.is_empty() {
                    let names = uses.get_mut(&home).unwrap().entry(path.clone());
                    names.or_default().extend(called);
                }
            }
        }
    }

    /// The module in which the item of a path is defined; none where the path ends at a module or leads out of the crate.
    fn home(&self, from: &ModulePath, path: &[String]) -> Option<ModulePath> {
        self.follow(from, path, 0)
            .filter(|(_, is_item)| *is_item)
            .map(|(home, _)| home)
    }

    /// Where a path leads that is written in a module: to a module and whether to an item in it.
    fn follow(
        &self,
        from: &ModulePath,
        path: &[String],
        depth: usize,
    ) -> Option<(ModulePath, bool)> {
        let (first, rest) = path.split_first()?;
        if depth > 20 {
            return None;
        }
        let below = [from.clone(), vec![first.clone()]].concat();
        let (start, rest) = match first.as_str() {
            "crate" => (Vec::new(), rest),
            "self" => (from.clone(), rest),
            "super" => (from[..from.len().checked_sub(1)?].to_vec(), rest),
            _ if self.modules.contains_key(&below) => (below, rest),
            name => {
                let import = self.modules[from].import(name)?;
                let whole = [&import.path, rest].concat();
                return self.follow(from, &whole, depth + 1);
            }
        };
        let Some((next, rest)) = rest.split_first() else {
            return Some((start, false));
        };
        let below = [start.clone(), vec![next.clone()]].concat();
        if next == "super" || self.modules.contains_key(&below) {
            return self.follow(
                &start,
                &[std::slice::from_ref(next), rest].concat(),
                depth + 1,
            );
        }
        match self.modules[&start].import(next) {
            Some(import) => self.follow(&start, &[&import.path, rest].concat(), depth + 1),
            None => Some((start, true)),
        }
    }
}

impl Module {
    fn import(&self, name: &str) -> Option<&Import> {
        self.imports.iter().find(|import| import.name == name)
    }

    fn is_imported(&self, place: usize) -> bool {
        self.imports
            .iter()
            .any(|import| import.place.contains(&place))
    }

    /// Whether the code of the module names something beyond its imports.
    fn names(&self, name: &str) -> bool {
        let mut named = self
            .tokens
            .iter()
            .enumerate()
            .filter(|(_, it)| it.text == name);
        named.any(|(place, _)| {
            !self.is_imported(place) && (place == 0 || self.tokens[place - 1].text != ".")
        })
    }

    /// Whether the code calls a function on a value or on the type itself.
    fn calls(&self, name: &str) -> bool {
        let is_called = |place: usize| {
            let before = |back: usize| {
                place
                    .checked_sub(back)
                    .map(|k| self.tokens[k].text.as_str())
            };
            before(1) == Some(".") || (before(1) == Some("::") && before(2) == Some("Self"))
        };
        let mut named = self
            .tokens
            .iter()
            .enumerate()
            .filter(|(_, it)| it.text == name);
        named.any(|(place, _)| is_called(place))
            && !self
                .tokens
                .windows(2)
                .any(|it| it[0].text == "fn" && it[1].text == name)
    }

    /// Paths of at least two names in the code beyond its imports.
    fn paths(&self) -> Vec<Vec<String>> {
        let text = |k: usize| self.tokens.get(k).map_or("", |token| token.text.as_str());
        let mut paths = Vec::new();
        for start in 0..self.tokens.len() {
            let is_first = start == 0 || ![".", "::"].contains(&text(start - 1));
            if !is_first || !is_name(text(start)) || self.is_imported(start) {
                continue;
            }
            let mut path = vec![text(start).to_owned()];
            let mut at = start + 1;
            while text(at) == "::" && is_name(text(at + 1)) {
                path.push(text(at + 1).to_owned());
                at += 2;
            }
            if path.len() > 1 {
                paths.push(path);
            }
        }
        paths
    }
}

/// Files that use each other.
#[derive(Debug)]
pub(super) struct Circle {
    pub(super) files: Vec<PathBuf>,
    /// The uses among them.
    pub(super) because: Vec<String>,
}

/// For each module the modules it uses, and the names by which it does.
type Uses = BTreeMap<ModulePath, BTreeMap<ModulePath, BTreeSet<String>>>;

/// Modules that a module uses, directly or through others.
fn reached<'a>(path: &ModulePath, uses: &'a Uses) -> BTreeSet<&'a ModulePath> {
    let mut found = BTreeSet::new();
    let mut open: Vec<&ModulePath> = uses[path].keys().collect();
    while let Some(next) = open.pop() {
        if found.insert(next) {
            open.extend(uses[next].keys());
        }
    }
    found
}

fn is_name(text: &str) -> bool {
    text.starts_with(|c: char| c.is_alphabetic() || c == '_')
}

/// Modules that have files of their own: `mod name;`.
fn declared_modules(tokens: &[Token]) -> Vec<String> {
    let declarations = tokens
        .windows(3)
        .filter(|it| it[0].text == "mod" && it[2].text == ";");
    declarations.map(|it| it[1].text.clone()).collect()
}

/// Types that a file adds functions to without a trait, with the names of the functions.
fn impl_blocks(tokens: &[Token]) -> Vec<(String, Vec<String>)> {
    let mut blocks = Vec::new();
    for (at, token) in tokens.iter().enumerate() {
        // An `impl` of an argument or a result stands behind a bracket, an arrow or the like.
        let begins = at == 0 || ["}", ";", "]"].contains(&tokens[at - 1].text.as_str());
        if token.text != "impl" || !begins {
            continue;
        }
        let open = (at..tokens.len()).find(|&k| tokens[k].text == "{").unwrap();
        let head = &tokens[at + 1..open];
        if head.iter().any(|token| token.text == "for") {
            continue;
        }
        let mut depth = 0_isize;
        let named = head.iter().find(|token| {
            match token.text.as_str() {
                "<" => depth += 1,
                ">" => depth -= 1,
                _ => {}
            }
            depth == 0 && is_name(&token.text)
        });
        let names = functions(&tokens[open..=closing(tokens, open)]);
        let names = names.into_iter().map(|function| function.name).collect();
        blocks.extend(named.map(|named| (named.text.clone(), names)));
    }
    blocks
}

fn imports(tokens: &[Token]) -> Vec<Import> {
    let mut imports = Vec::new();
    let mut at = 0;
    while at < tokens.len() {
        // `use<'a>` in a type is no import.
        if tokens[at].text != "use" || tokens[at + 1].text == "<" {
            at += 1;
            continue;
        }
        let end = (at..tokens.len()).find(|&k| tokens[k].text == ";").unwrap();
        let is_public = at > 0 && ["pub", ")"].contains(&tokens[at - 1].text.as_str());
        let tree: Vec<&str> = tokens[at + 1..end]
            .iter()
            .map(|token| token.text.as_str())
            .collect();
        for (path, name) in leaves(&[], &tree) {
            imports.push(Import {
                path,
                name,
                is_public,
                place: at..end + 1,
            });
        }
        at = end + 1;
    }
    imports
}

/// The paths of an import tree with the names that they get.
fn leaves(prefix: &[String], tree: &[&str]) -> Vec<(Vec<String>, String)> {
    let mut path = prefix.to_vec();
    for (k, part) in tree.iter().enumerate() {
        match *part {
            "::" => {}
            "{" => {
                let inner = &tree[k + 1..tree.len() - 1];
                let branches = branches(inner).into_iter();
                return branches.flat_map(|branch| leaves(&path, branch)).collect();
            }
            "as" => return vec![(path, tree[k + 1].to_owned())],
            // A glob of another crate; there is none of a module of the same one but in tests.
            "*" => return Vec::new(),
            "self" if !path.is_empty() => {}
            name => path.push(name.to_owned()),
        }
    }
    let name = path.last().cloned();
    name.map(|name| (path, name)).into_iter().collect()
}

/// The parts between commas that no bracket holds.
fn branches<'a, 'b>(tree: &'a [&'b str]) -> Vec<&'a [&'b str]> {
    let (mut depth, mut start) = (0_usize, 0);
    let mut found = Vec::new();
    for (k, part) in tree.iter().enumerate() {
        match *part {
            "{" => depth += 1,
            "}" => depth -= 1,
            "," if depth == 0 => {
                found.push(&tree[start..k]);
                start = k + 1;
            }
            _ => {}
        }
    }
    found.push(&tree[start..]);
    found.retain(|branch| !branch.is_empty());
    found
}
