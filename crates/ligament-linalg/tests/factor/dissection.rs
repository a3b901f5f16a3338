//! Orders by nested dissection: permutations, the same on any number of threads, with little fill.

use ligament_linalg::Elimination;
use rayon::ThreadPoolBuilder;

use super::systems::*;
use super::threads::halves;

/// The unknowns in the order of nested dissection.
fn dissected(graph: &Graph, components: usize) -> Vec<usize> {
    let system = System::new(graph, components, &mut Random(41));
    let symbolic = system.symbolic(Elimination::NestedDissection);
    symbolic.unknown_of_row().to_vec()
}

/// Number of entries of L, with the diagonal, by walks up the elimination tree from the entries of each row (Liu 1990).
fn n_values(graph: &Graph, order: &[usize]) -> usize {
    let n = order.len();
    let mut place = vec![0; n];
    for (row, &point) in order.iter().enumerate() {
        place[point] = row;
    }
    let mut before = vec![Vec::new(); n];
    for &(a, b) in &graph.pairs {
        let [a, b] = [place[a], place[b]];
        before[a.max(b)].push(a.min(b));
    }
    let (mut parent, mut seen_for) = (vec![None; n], vec![usize::MAX; n]);
    let mut count = n;
    for row in 0..n {
        seen_for[row] = row;
        for &column in &before[row] {
            let mut next = column;
            while seen_for[next] != row {
                seen_for[next] = row;
                count += 1;
                next = *parent[next].get_or_insert(row);
            }
        }
    }
    count
}

/// Graphs of all kinds, connected or not, small and large enough for parallel tasks: each unknown comes once, in the same order on 1, 2 and
/// 3 threads.
#[test]
fn orders_are_permutations_on_any_number_of_threads() {
    let mut random = Random(42);
    let star = Graph::new(3000, (1..3000).map(|it| (0, it)));
    for (graph, components) in [
        (Graph::new(0, []), 1),
        (Graph::new(1, []), 3),
        (Graph::new(500, []), 2),
        (Graph::chain(5000), 1),
        (star, 2),
        (Graph::complete(60), 3),
        (Graph::lattice(50, 3.0), 3),
        (Graph::random(2000, 1.0, &mut random), 2),
        (Graph::random(300, 40.0, &mut random), 1),
        (Graph::lattice(40, 1.0).beside(&Graph::complete(30)), 3),
    ] {
        let [order, of_two, of_three] = [1, 2, 3].map(|threads| {
            let pool = ThreadPoolBuilder::new().num_threads(threads).build();
            pool.unwrap().install(|| dissected(&graph, components))
        });
        let mut sorted = order.clone();
        sorted.sort_unstable();
        assert!(sorted.into_iter().eq(0..components * graph.n_points));
        assert_eq!(order, of_two);
        assert_eq!(order, of_three);
    }
}

/// On a grid of k x k points, n = k^2, nested dissection leaves 31/4 n log2 n + O(n) entries in L (George 1973; Lipton, Rose and Tarjan
/// 1979), with a negative O(n). A chain has one entry below the diagonal of each column at least, 2 n - 1 in all; two ends for each
/// separator and parts of 16 points in a row leave less than 3 n.
#[test]
fn the_fill_of_grids_and_chains_is_bounded() {
    for side in [20, 40, 80] {
        let grid = Graph::lattice(side, 1.0);
        let n = (side * side) as f64;
        let count = n_values(&grid, &dissected(&grid, 1)) as f64;
        assert!(count < 31.0 / 4.0 * n * n.log2(), "{side}: {count}");
    }
    let chain = Graph::chain(5000);
    let count = n_values(&chain, &dissected(&chain, 1));
    assert!((9999..15_000).contains(&count), "{count}");
}

/// On a lattice with bonds within three spacings, the order has less fill than straight separators of three columns or rows at the middle,
/// and on a lattice in random order as well.
#[test]
fn separators_are_better_than_halves() {
    let side = 60;
    let lattice = Graph::lattice(side, 3.0);
    let by_halves = n_values(&lattice, &halves(side)) as f64;
    let place = Random(43).permutation(side * side);
    let pairs = lattice.pairs.iter();
    let shuffled = Graph::new(side * side, pairs.map(|&(a, b)| (place[a], place[b])));
    for graph in [lattice, shuffled] {
        let ratio = n_values(&graph, &dissected(&graph, 1)) as f64 / by_halves;
        assert!(ratio < 1.0, "{ratio}");
    }
}
